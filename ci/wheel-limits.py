"""Checks the size of a wheel, and the glibc version that its program needs.

    python3 ci/wheel-limits.py mpm_verify-*.whl

The platform tag of a wheel promises a version of glibc. A program that needs a later one would be
installed, and would fail to start.
"""

from __future__ import annotations

import re
import sys
import zipfile
from pathlib import Path

LARGEST = 25e6  # bytes; the Python registry accepts 100 MB
FILES = ("mpm_verify/__init__.py", "mpm_verify/py.typed", "mpm_verify/results.py",
         "pytest_mpm_verify.py", "/entry_points.txt")
LEGACY = {"manylinux2014": (2, 17)}


def promised(name: str) -> tuple[int, int] | None:
    """Returns the glibc version in the platform tag of a wheel; None for other platforms."""
    versions = [version for tag, version in LEGACY.items() if tag in name]
    versions += [(int(a), int(b)) for a, b in re.findall(r"manylinux_(\d+)_(\d+)", name)]
    return max(versions, default=None)


def needed(program: bytes) -> tuple[int, int]:
    """Returns the latest glibc version that an ELF file names, or (0, 0)."""
    names = re.findall(rb"\0GLIBC_(\d+)\.(\d+)", program)
    return max(((int(a), int(b)) for a, b in names), default=(0, 0))


def main(paths: list[str]) -> None:
    if not paths:
        sys.exit(__doc__)
    for path in map(Path, paths):
        size = path.stat().st_size
        with zipfile.ZipFile(path) as wheel:
            names = wheel.namelist()
            missing = [f for f in FILES if not any(name.endswith(f) for name in names)]
            programs = [n for n in names if re.search(r"/scripts/mpm-verify(\.exe)?$", n)]
            version = max((needed(wheel.read(n)) for n in programs), default=(0, 0))
        tag = promised(path.name)
        print(f"{path.name}: {size / 1e6:.1f} MB, needs glibc {version[0]}.{version[1]}")
        if missing or not programs:
            sys.exit(f"the wheel lacks {', '.join(missing) or 'the program'}")
        if not size <= LARGEST:
            sys.exit(f"the wheel is larger than {LARGEST / 1e6:.0f} MB")
        if tag is not None and not (0, 0) < version <= tag:
            sys.exit(f"the tag promises glibc {tag[0]}.{tag[1]}")


main(sys.argv[1:])
