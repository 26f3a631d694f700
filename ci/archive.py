"""Packs the program of a wheel into an archive for one target, as `cargo binstall` expects it.

    python3 ci/archive.py WHEEL TARGET FOLDER

The archive has one folder with the program, the licences and the changelog. Its name follows
`[package.metadata.binstall]` in Cargo.toml.
"""

from __future__ import annotations

import re
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TEXTS = ("README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE-MIT", "LICENSE-APACHE")


def main(wheel: str, target: str, folder: str) -> None:
    manifest = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
    [version] = re.findall(r'^version = "(.*)"$', manifest, re.M)
    name = f"mpm-verify-v{version}-{target}"
    out = Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(wheel) as package, tempfile.TemporaryDirectory() as scratch:
        [program] = [n for n in package.namelist()
                     if re.search(r"/scripts/mpm-verify(\.exe)?$", n)]
        path = Path(scratch, Path(program).name)
        path.write_bytes(package.read(program))
        path.chmod(0o755)
        files = [path, *(ROOT / text for text in TEXTS)]
        if "windows" in target:
            archive = out / f"{name}.zip"
            with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
                for file in files:
                    packed.write(file, f"{name}/{file.name}")
        else:
            archive = out / f"{name}.tar.gz"
            with tarfile.open(archive, "w:gz") as packed:
                for file in files:
                    packed.add(file, f"{name}/{file.name}", filter=anonymous)
    print(archive)


def anonymous(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    """Removes the user of the build machine from an entry."""
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry


if len(sys.argv) != 4:
    sys.exit(__doc__)
main(*sys.argv[1:])
