"""Tests of the pytest plugin, with the NumPy client as the solver.

The plugin is an entry point of the wheel, or is loaded by `-p pytest_mpm_verify`. The program is on
the path, or is named by the variable `MPM_VERIFY`.
"""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

SOLVERS = Path(__file__).resolve().parents[2] / "examples" / "solvers"
# Half a step back at the start, so that the order is two with gravity too.
SOLVER = shlex.join([sys.executable, str(SOLVERS / "numpy_mpm.py")])
WRONG_STRESS = """
import sys
sys.path.insert(0, {folder!r})
from numpy_mpm import Mpm, serve

class WrongStress(Mpm):
    def setup(self, problem):
        points = super().setup(problem)
        self.lam, self.mu = 1.1 * self.lam, 1.1 * self.mu
        return points

serve(WrongStress("linear", "musl", 1.0, "at_zero"))
"""


@pytest.fixture
def run(pytester, monkeypatch):
    """Runs pytest with the plugin in a folder without tests."""
    plugin = [] if os.environ.get("PLUGIN_IS_INSTALLED") else ["-p", "pytest_mpm_verify"]
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")

    def run(*arguments: str):
        return pytester.runpytest_subprocess(*plugin, *arguments)

    return run


def test_a_sound_solver_passes(run) -> None:
    result = run("--mpm-verify", SOLVER, "--mpm-verify-suites", "vibrating-bar", "-v")
    result.assert_outcomes(passed=1)
    result.stdout.fnmatch_lines(["mpm-verify::vibrating-bar::numpy-mpm PASSED*"])


def test_a_wrong_stress_fails_with_the_report(run, pytester) -> None:
    path = pytester.path / "wrong.py"
    path.write_text(WRONG_STRESS.format(folder=str(SOLVERS)))
    solver = shlex.join([sys.executable, str(path)])
    result = run("--mpm-verify", solver, "--mpm-verify-suites", "vibrating-bar")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["FAIL: expected order at least*", "vibrating-bar: Vibrating bar",
                                 "*rms error of displacement at the end (m)",
                                 "error*order-too-low*: vibrating-bar::*", "*vibrating-bar.yaml*",
                                 "*mpm-verify explain order-too-low"])
    result.stdout.no_fnmatch_line("wrote *")


def test_a_named_suite_that_is_not_applicable_fails(run) -> None:
    arguments = ["--mpm-verify", SOLVER, "--mpm-verify-suites", "thrown-plastic-bar"]
    result = run(*arguments)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["not applicable: the solver lacks laws: j2"])
    allowed = run(*arguments, "--mpm-verify-allow-not-applicable", "-rs")
    allowed.assert_outcomes(skipped=1)
    allowed.stdout.fnmatch_lines(["SKIPPED*not applicable: the solver lacks laws: j2"])


def test_a_suite_of_a_pattern_that_is_not_applicable_is_skipped(run) -> None:
    run("--mpm-verify", SOLVER, "--mpm-verify-suites", "thrown-plastic-*").assert_outcomes(skipped=1)


def test_the_suite_of_a_file_is_named_by_the_file(run, pytester) -> None:
    suites = SOLVERS.parents[1] / "verification" / "plasticity-and-fluids"
    copy = pytester.path / "mine.yaml"
    copy.write_text((suites / "thrown-plastic-bar.yaml").read_text())
    run("--mpm-verify", SOLVER, "--mpm-verify-suites", "mine.yaml").assert_outcomes(failed=1)


def test_an_unknown_suite_is_a_usage_error(run) -> None:
    result = run("--mpm-verify", SOLVER, "--mpm-verify-suites", "no-such-suite")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*no-such-suite*"])


def test_without_the_option_nothing_runs(run, pytester) -> None:
    pytester.makepyfile("import sys\ndef test_import():\n    assert 'numpy' not in sys.modules\n")
    run().assert_outcomes(passed=1)
