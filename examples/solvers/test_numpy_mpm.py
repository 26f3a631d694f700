"""Tests of the NumPy client against its formal order, one per suite.

The program is on the path, or named by the variable `MPM_VERIFY`.
"""

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = os.environ.get("MPM_VERIFY", "mpm-verify")
SOLVER = shlex.join([sys.executable, str(Path(__file__).with_name("numpy_mpm.py"))])


@pytest.mark.parametrize(("suite", "options"), [
    ("vibrating-bar", "--scheme musl"),
    ("vibrating-bar", "--scheme usl"),
    ("mms-fixed-bar-small", "--start half_step_back"),
    ("mms-periodic-bar-small", "--start half_step_back"),
    ("mms-axis-aligned-2d-periodic", "--start half_step_back --basis cubic_bspline"),
])
def test_the_order_is_two(suite: str, options: str) -> None:
    command = [PROGRAM, "run", suite, "--gate", "--solver", f"{SOLVER} {options}"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
