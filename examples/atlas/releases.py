"""Every release of a code, and some modes of the newest, under few small runs; their tables."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from math import exp, inf, log
from statistics import fmean

from plan import CODES, Code, packages

# The small runs: fewer levels of a suite, or longer steps, by edits of its text.
PANELS: dict[str, dict[str, dict[str, str]]] = {
    "plane": {
        "translating-block": {"[16, 24, 32, 48]": "[16, 24]"},
        "falling-block": {"[16, 24, 32, 48]": "[16, 24]"},
        "free-bar-pulse-small": {"[64, 80, 96, 128]": "[48, 64, 80, 96]"},
        "lame-square": {"[12, 16, 20, 26]": "[12, 14, 16, 20]"},
        "narrow-gap": {"dt: 0.005": "dt: 0.025"},
    },
    "space": {
        "translating-block-3d": {"[8, 16, 24, 32]": "[8, 16]"},
        "falling-block-3d": {"[8, 16, 24, 32]": "[8, 16]"},
        "free-bar-pulse-hencky-3d": {"[32, 40, 48, 56]": "[24, 28, 32, 40]"},
        "lame-block": {"[9, 12, 15, 18]": "[6, 8]"},
        "narrow-gap-3d": {"dt: 0.01": "dt: 0.02"},
    },
}
# Own method with the same basis functions, to which errors are compared.
OWN = {"linear": "mpm-linear-flip-", "quadratic": "mpm-quadratic-bspline-apic-"}
# The largest error of a translation, relative to its distance, of a code in single precision.
TRANSLATION = 1e-3
VERDICTS = ["no defect", "remark", "not examined", "defect", "cannot start"]
# Suites whose errors are compared: a motion that deforms.
DEFORMING = ("free-bar-pulse", "lame")


@dataclass
class Column:
    """A release of a code in one mode."""

    code: Code
    release: str
    mode: str
    arguments: list[str]

    @property
    def group(self) -> str:
        implicit = self.code.implicit or {"newmark", "bossak"} & {*self.arguments}
        return f"{'implicit' if implicit else 'explicit'}, {'f32' if 'f32' in self.mode else 'f64'}"

    def owns(self, row: dict[str, str]) -> bool:
        """Whether a row of results.csv is one of this column."""
        return (row["code"], row["release"], row["variant"]) == (self.code.name, self.release, self.mode)


def columns() -> list[Column]:
    """All releases in the main modes of their code, and the newest in the other modes."""
    found = []
    for code in CODES:
        if code.panel:
            releases = [*packages()[code.name]]
            found += [Column(code, release, mode, arguments) for mode, arguments in code.variants.items()
                      for release in releases]
            found += [Column(code, releases[-1], mode, arguments) for mode, arguments in code.modes.items()]
    return found


def summary(rows: list[dict[str, str]]) -> str:
    """The first screen: a row for each column, ranked within its group."""
    lines = []
    for column in columns():
        mine = [row for row in rows if column.owns(row)]
        for examined in [row for row in mine if row["suite"] == "doctor" or row["verdict"] == "cannot start"]:
            lines.append((column.group, *judge(column, examined, mine, rows)))
    lines.sort(key=lambda line: line[:2])
    out = []
    for group, some in groupby(lines, key=lambda line: line[0]):
        out += [f"**{group}**", "",
                "| code and release | capabilities | verdict | error | worst findings |",
                "| --- | --- | --- | --- | --- |"]
        out += [f"| {' | '.join(line[2:])} |" for line in some] + [""]
    return "\n".join(out)


def judge(column: Column, examined: dict[str, str], mine: list[dict[str, str]], rows: list[dict[str, str]]) -> tuple:
    """Key of the rank, name, verdict, relative error, and findings of a column."""
    ratios = [ratio for row in mine if (ratio := relative(column, row, rows))]
    error = exp(fmean(map(log, ratios))) if ratios else inf
    failed = dict.fromkeys(row["suite"] for row in mine if row["verdict"] == "failed")
    found = [f"`{suite}` fails" for suite in failed]
    found += [f"`{row['suite']}`: error {float(row['errors'].split()[-1]):.1e}" for row in mine
              if row["suite"].startswith("translating") and row["errors"] and not row["failed"]
              and not max(map(float, row["errors"].split())) < TRANSLATION]
    if examined["verdict"] == "defect":
        found.insert(0, examined["reason"])
    verdict = "defect" if found else examined["verdict"]
    return ((VERDICTS.index(verdict), error), f"{column.code.label} {column.release}, {column.mode}",
            column.code.about, verdict, f"{error:.2f}" if ratios else "",
            linked("; ".join(found) or examined["reason"], column.code))


def linked(findings: str, code: Code) -> str:
    """Findings, with links to the texts about them; of a message, the error."""
    findings = next((part for part in findings.split(" | ") if "Error:" in part), findings)
    for name, text in code.reports.items():
        findings = findings.replace(name, f"[{name}](../examples/atlas/reports/{text}.md)")
    return findings


def relative(column: Column, row: dict[str, str], rows: list[dict[str, str]]) -> float | None:
    """Error on the finest level, divided by that of the own method; none if all errors are rounding."""
    if not row["suite"].startswith(DEFORMING) or not row["errors"] or row["failed"]:
        return None
    if row["reason"].startswith("0 usable levels"):
        return None
    for own in rows:
        if (own["code"], own["release"], own["suite"]) == ("own", "here", row["suite"]) and \
                own["case"].startswith(OWN[column.code.basis]):
            return float(row["errors"].split()[-1]) / float(own["errors"].split()[-1])
    return None


def changes(rows: list[dict[str, str]]) -> str:
    """Releases whose results differ from those of the release before, by more than two per cent."""
    lines = ["| code and mode | release | run | before | since then |", "| --- | --- | --- | --- | --- |"]
    for _, some in groupby(columns(), key=lambda column: (column.code.name, column.mode)):
        before: dict[str, str | float] = {}
        for column in some:
            for row in [row for row in rows if column.owns(row)]:
                key, result = row["suite"] + row["case"], outcome(row)
                was = before.setdefault(key, result)
                if not (result == was or isinstance(result, float) and isinstance(was, float)
                        and abs(result - was) <= 0.02 * was + 1e-10):
                    cells = [value if isinstance(value, str) else f"{value:.1e}" for value in (was, result)]
                    lines.append(f"| {column.code.label}, {column.mode} | {column.release} | `{row['suite']}` | "
                                 f"{' | '.join(cells)} |")
                before[key] = result
    return "\n".join(lines)


def outcome(row: dict[str, str]) -> str | float:
    """The findings of `doctor`, or the error on the finest level."""
    if row["suite"] == "doctor":
        return row["reason"] or row["verdict"]
    return float(row["errors"].split()[-1]) if row["errors"] and not row["failed"] else "failed"
