"""Sound configurations of the clients with gradients: no study may call one of their derivatives wrong.

    python3 tests/clients/gradient_configurations.py PROGRAM [--jax] [--parallel N]

Each configuration runs a suite of `verification/gradients` on few and coarse grids. The exit status is 1 if a
derivative is `wrong`, or if a solver fails. `--jax` adds the client in reverse mode, which needs JAX.
"""

from __future__ import annotations

import argparse
import itertools
import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SUITES = ROOT / "verification/gradients"
BASES = ["linear", "quadratic_bspline", "cubic_bspline"]
# Suite -> replacements that make it small: old text -> new text.
SMALL = {
    "gradient-bar": {"cells: 32\n": "", r"  sweep: .*\n": "", r"\[8, 16, 32, 64\]": "[6, 12]",
                     "{young: E, density: rho, initial_velocity: v0}": "{young: E}"},
    "gradient-bar-crossings": {"cells: 32\n": "", r"  sweep: .*\n": "", r"\[8, 16, 32\]": "[8, 16]"},
    "gradient-wave": {"cells: 32\n": "", r"  sweep: .*\n": "", r"\[8, 16, 32, 64\]": "[8, 16]"},
    "gradient-yield": {"cells: 32\n": "", r"  sweep: .*\n": "", r"\[16, 32, 64, 128\]": "[8, 16]",
                       "{yield: Y, hardening: H, young: E}": "{yield: Y, young: E}"},
    "gradient-sliding-block": {r"\[1, 2, 4, 8\]": "[1, 2]"},
}


def configurations(with_jax):
    """Pairs of a suite and the options of a client."""
    for basis, scheme, start in itertools.product(BASES, ["musl", "usl"], ["at_zero", "half_step_back"]):
        for flip in ["1", "0.95"] if start == "at_zero" else ["1"]:
            yield "gradient-bar", "numpy", f"--basis {basis} --scheme {scheme} --start {start} --flip {flip}"
    for suite in ["gradient-bar-crossings", "gradient-wave", "gradient-yield"]:
        for basis, scheme in itertools.product(BASES, ["musl", "usl"]):
            if (suite, basis, scheme) == ("gradient-bar-crossings", "linear", "usl"):
                continue  # not sound: the solver fails, also without derivatives
            yield suite, "numpy", f"--basis {basis} --scheme {scheme} --start half_step_back"
    for basis in BASES:
        yield "gradient-sliding-block", "numpy", f"--basis {basis} --scheme usl --start half_step_back"
    if with_jax:
        for suite, basis in itertools.product(["gradient-bar", "gradient-wave"], BASES):
            yield suite, "jax", f"--basis {basis}"


def small(suite, folder):
    """A small copy of a suite, without its expectations."""
    text = (SUITES / f"{suite}.yaml").read_text()
    for old, new in SMALL[suite].items():
        pattern = old if "\\" in old else re.escape(old)
        text, count = re.subn(pattern, new, text)
        if count == 0:
            sys.exit(f"{suite} does not contain `{old}`")
    text = re.sub(r"\nmethods:.*", "\n", text, flags=re.DOTALL)
    path = Path(folder) / f"{suite}.yaml"
    path.write_text(text)
    return path


def verdicts(program, suite, client, options):
    """The verdict of each derivative."""
    script = ROOT / f"examples/solvers/{client}_mpm.py"
    solver = f"{sys.executable} {script} {options}" + (" --gradient" if client == "numpy" else "")
    command = [program, "run", suite, "--format", "json", "--solver", solver, "--solver-timeout", "600s"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        cases = json.loads(run.stdout)["suites"][0]["cases"]
        return {case["case"]: case["verdict"] for case in cases}
    except (ValueError, KeyError):
        return {"": f"no result: {(run.stderr or run.stdout).partition(chr(10))[0]}"}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--jax", action="store_true")
    parser.add_argument("--parallel", type=int, default=1)
    arguments = parser.parse_args()
    every = list(configurations(arguments.jax))
    accused = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(arguments.parallel) as pool:
        suites = {suite: small(suite, folder) for suite in SMALL}
        runs = [pool.submit(verdicts, arguments.program, suites[suite], client, options)
                for suite, client, options in every]
        for (suite, client, options), run in zip(every, runs):
            sound = all(v in ("smooth", "linear", "jumps", "at rounding") for v in run.result().values())
            accused += not sound
            print(f"{suite:24} {client:6} {options:62}", ", ".join(run.result().values()),
                  "" if sound else "ACCUSED", flush=True)
    print(f"{len(every)} configurations, {accused} accused")
    sys.exit(accused > 0)


if __name__ == "__main__":
    main()
