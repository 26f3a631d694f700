"""Runs a solver on a suite, and prints the errors of each level with `mpm_verify.results`."""

from __future__ import annotations

import subprocess

import mpm_verify
from mpm_verify import results


def main() -> None:
    command = ["mpm-verify", "run", "vibrating-bar", "--format", "json",
               "--solver", "python numpy_mpm.py"]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    for row in results.rows(results.load(run.stdout)):
        print(f"{row['case']}  h = {row['h']:8.4f} m  error {row['judged']:.3e} m")
    print("protocol", mpm_verify.PROTOCOL)


if __name__ == "__main__":
    main()
