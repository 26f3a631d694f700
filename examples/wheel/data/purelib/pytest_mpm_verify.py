"""A pytest plugin that runs a solver on suites of `mpm-verify`, with one test for each case.

    pytest --mpm-verify "python my_solver.py"
    pytest --mpm-verify "python my_solver.py" --mpm-verify-suites "vibrating-bar my/suite.yaml"

The suites run once, while tests are collected, as by `mpm-verify run --gate`. The test of a case
fails if the gate fails, and shows the report of the suite. If the solver lacks what a suite needs,
the test is skipped; a suite that is named on its own fails instead, as in the gate.

The plugin is a module of its own, since pytest imports it in every run: `mpm_verify` would import
NumPy even where no solver is tested.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Optional

import pytest

# Suites of docs/your-own-solver.md that need linear elasticity and no more than free or roller faces.
DEFAULT_SUITES = (
    "translating-block", "falling-block", "free-bar-second-mode", "square-between-rollers")

# Results of the gate that neither pass nor fail unless the suite is named.
_NOT_TESTED = ("not applicable", "explored")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the options of the plugin."""
    group = parser.getgroup("mpm-verify", "verification of an MPM solver")
    group.addoption("--mpm-verify", metavar="COMMAND", default=None,
                    help="command that starts the solver: runs it on suites of mpm-verify")
    group.addoption("--mpm-verify-suites", metavar="SUITES", action="append", default=[],
                    help="names, files, groups or patterns of suites, separated by spaces or "
                         f"commas; default: {' '.join(DEFAULT_SUITES)}")
    group.addoption("--mpm-verify-config", metavar="FILE", default=None,
                    help="orders, bounds and exceptions of the solver (mpm-verify --solver-config)")
    group.addoption("--mpm-verify-allow-not-applicable", action="store_true", default=False,
                    help="skip suites that are named but not applicable to the solver")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(session: pytest.Session, config: pytest.Config,
                                  items: list[pytest.Item]) -> None:
    """Runs the suites, and adds a test for each case before `-k` selects among the tests."""
    command = config.getoption("--mpm-verify")
    if command is None:
        return
    named = [name for value in config.getoption("--mpm-verify-suites")
             for name in re.split(r"[\s,]+", value) if name]
    required = set()
    if not config.getoption("--mpm-verify-allow-not-applicable"):
        required = {_suite_name(name) for name in named}
    collector = Verification.from_parent(session, name="mpm-verify", nodeid="mpm-verify")
    with tempfile.TemporaryDirectory(prefix="mpm-verify-") as folder:
        report = _run(command, named or list(DEFAULT_SUITES), config, folder)
        for suite in report["suites"]:
            path = Path(folder, f"{suite['suite']}.txt")
            text = path.read_text(encoding="utf-8") if path.is_file() else ""
            for case in suite["cases"]:
                items.append(CaseItem.from_parent(
                    collector, name=f"{suite['suite']}::{case['case']}", case=case, text=text,
                    required=suite["suite"] in required))


def _run(command: str, suites: list[str], config: pytest.Config, folder: str) -> dict[str, Any]:
    """Returns the report of one run of the gate, whose texts are in the folder."""
    program = os.environ.get("MPM_VERIFY") or shutil.which("mpm-verify")
    if program is None:
        raise pytest.UsageError("--mpm-verify: the command `mpm-verify` is not on the path")
    arguments = [program, "run", *suites, "--solver", command, "--gate", "--format", "json",
                 "--out", folder]
    settings = config.getoption("--mpm-verify-config")
    if settings is not None:
        arguments += ["--solver-config", settings]
    run = subprocess.run(arguments, capture_output=True, encoding="utf-8", errors="replace",
                         check=False)
    # The exit status is 1 if a case fails. Only a document on the standard output can be tested.
    if run.returncode not in (0, 1) or not run.stdout.lstrip().startswith("{"):
        raise pytest.UsageError(
            f"mpm-verify failed with exit status {run.returncode}:\n{run.stderr.strip()}")
    from mpm_verify import results  # imports NumPy: only if the option is given

    report = results.load(run.stdout)
    # Diagnostics begin with `error[CODE]: SUITE::CASE: `.
    diagnostics = re.split(r"(?=^(?:error\[|wrote ))", run.stderr, flags=re.M)
    for suite in report["suites"]:
        for case in suite["cases"]:
            head = f"]: {suite['suite']}::{case['case']}: "
            case["diagnostics"] = [text for text in diagnostics if head in text.split("\n", 1)[0]]
    if not any(True for _ in results.cases(report)):
        raise pytest.UsageError(f"mpm-verify ran no case:\n{run.stderr.strip()}")
    return report


def _suite_name(argument: str) -> str:
    """The name of the suite in a file, or the argument itself if it is a name or a pattern."""
    path = Path(argument)
    if path.is_file():
        line = re.search(r"^suite:\s*[\"']?([^\s\"'#]+)", path.read_text(encoding="utf-8"), re.M)
        return line.group(1) if line else argument
    return argument


class Verification(pytest.Collector):
    """The parent of the tests of all cases."""

    def collect(self) -> list[pytest.Item]:
        """Returns nothing: the tests are added after pytest has collected its own."""
        return []


class CaseFailure(Exception):
    """The gate fails for a case."""


class CaseItem(pytest.Item):
    """The test of one case: passes, fails or is skipped as the gate decided."""

    def __init__(self, *, case: dict[str, Any], text: str, required: bool, **options: Any) -> None:
        super().__init__(**options)
        self.case = case
        self.text = text
        self.required = required  # whether a result that is not applicable fails

    def runtest(self) -> None:
        """Raises `CaseFailure` if the case fails, or skips it with the reason of the gate."""
        result = self.case.get("result")
        is_excepted = result == "known limit" and not self.case["passed"]
        if is_excepted or (result in _NOT_TESTED and not self.required):
            pytest.skip(f"{result}: {self.case['reason']}")
        if not self.case["passed"]:
            raise CaseFailure(self.summary())

    def summary(self) -> str:
        """What is wrong, and the report of the suite."""
        reason = "; ".join(self.case.get("unmet") or []) or self.case["reason"]
        verdict = self.case.get("result") or "FAIL"
        diagnostics = "".join(self.case["diagnostics"])
        return f"{verdict}: {reason}\n\n{self.text}\n{diagnostics}".rstrip()

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException],
                     style: Optional[Any] = None) -> Any:
        """Shows the report of the suite instead of a traceback of this plugin."""
        if isinstance(excinfo.value, CaseFailure):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, Optional[int], str]:
        """Returns the heading of a failure."""
        return self.path, None, f"mpm-verify {self.name}"
