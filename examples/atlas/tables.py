"""The tables of docs/atlas.md and docs/atlas-newest.md, from results.csv."""

from __future__ import annotations

import csv

from plan import (CODES, EXACT, FREE_2D, FREE_3D, GAPS, HERE, LAGRANGIAN, PLANE, SPACE, own_cases)
from releases import OWN, PANELS, changes, columns, summary

DOCS = HERE.parent.parent / "docs"
RESULTS = HERE / "results.csv"

# The columns of results.csv, one row for each case. `release` is empty for full runs of the newest release; for
# `doctor`, `reason` has its findings and `cells` the number of examinations. Otherwise `cells`, `failed` (cells of the
# levels that fail), `errors` and `momentum` (relative drift) have one entry for each level. The columns from
# `value_difference` to `sweep` are checks of a derivative.
COLUMNS = ["code", "release", "variant", "suite", "case", "derivative_by", "verdict", "order", "order_low",
           "order_high", "cells", "failed", "errors", "momentum", "lacks", "value_difference", "taylor_orders",
           "derivative_error", "sweep", "seconds", "reason"]


def read() -> list[dict[str, str]]:
    """Returns the rows of results.csv; none if there is no such file."""
    if not RESULTS.exists():
        return []
    with RESULTS.open(newline="") as file:
        return list(csv.DictReader(file))


def store(rows: list[dict[str, str]]) -> None:
    """Writes results.csv, code by code."""
    names = [code.name for code in CODES] + ["own"]
    with RESULTS.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: names.index(row["code"])))


def cell(run: dict[str, str]) -> str:
    """Order with its interval and the verdict; for a translation, the largest error."""
    if run["lacks"]:
        return f"not applicable ({run['lacks']})"
    if run["verdict"] == "failed":
        return f"failed with {' and '.join(run['failed'].split())} cells"
    errors = [float(error) for error in run["errors"].split()]
    if run["suite"].startswith("translating-block"):
        return f"error {max(errors):.1e}"
    if max(errors) < 1e-12:
        return f"error {max(errors):.0e}"
    order = [float(run[key]) for key in ("order", "order_low", "order_high") if run[key]]
    interval = order and "{:.2f} [{:.2f}, {:.2f}] ".format(*order)
    return f"{interval or ''}{run['verdict']}; {errors[-1]:.1e}"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def matrix(suites: list[str], reports: dict[str, list[dict]]) -> str:
    """Suites against the variants of codes. The MPM codes are compared with methods of this crate,
    finite elements and SPH have a table without them."""
    lagrangian = suites is LAGRANGIAN
    own_tables = (LAGRANGIAN, EXACT)
    columns = [(f"{code.title}, {variant}", code.name, variant) for code in CODES
               if set(code.suites) & set(suites)
               and (code.suites is suites if suites in own_tables else code.suites not in own_tables)
               for variant in code.variants]
    names = own_cases(suites[0])
    own = [run for run in reports["own"]
           if run["suite"] in suites and run["case"] in names and not lagrangian]
    methods = [label for label in dict.fromkeys(names.values())
               if any(names[run["case"]] == label for run in own)]
    rows = []
    for suite in suites:
        row = [f"`{suite}`"]
        for _, name, variant in columns:
            found = [run for run in reports.get(name, [])
                     if (run["suite"], run["variant"]) == (suite, variant)]
            row.append(cell(found[0]) if found else "not run yet")
        for label in methods:
            found = [run for run in own if run["suite"] == suite and names[run["case"]] == label]
            row.append("; ".join(start(run["case"]) + cell(run) for run in found))
        rows.append(row)
    return table(["suite", *(title for title, _, _ in columns), *methods], rows)


def panel(name: str, rows: list[dict[str, str]]) -> str:
    """The small runs: a cell for each suite, a row for the releases with the same cells."""
    lines: dict[tuple[str, ...], list[str]] = {}
    shown = [(column.code.label, column.mode, column.release, [row for row in rows if column.owns(row)])
             for column in columns() if column.code.panel == name]
    shown += [("mpm-verify", basis, "", [row for row in rows if (row["code"], row["release"]) == ("own", "here")
                                         and row["case"].startswith(method)]) for basis, method in OWN.items()]
    for label, mode, release, mine in shown:
        runs = {suite: [row for row in mine if row["suite"] == suite and row["cells"]] for suite in PANELS[name]}
        cells = [contact(some) if suite in GAPS else
                 "; ".join(start(run["case"]) + cell(run).replace("too few levels;", "error") for run in some)
                 for suite, some in runs.items()]
        if any(cells):
            lines.setdefault((f"{label}, {mode}", *cells), []).append(release)
    return table(["code and mode", "releases", *(f"`{suite}`" for suite in PANELS[name])],
                 [[title, ", ".join(releases), *cells] for (title, *cells), releases in lines.items()])


def contact(runs: list[dict[str, str]]) -> str:
    """The distances (cells) between which two bodies begin to interact."""
    ends = GAPS[runs[0]["suite"]] if runs else []
    apart = [3 - end for run, end in zip(runs, ends) if float(run["errors"] or "nan") < 1e-3]
    near = [3 - end for run, end in zip(runs, ends) if not float(run["errors"] or "nan") < 1e-3]
    below = f"below {min(apart):.3g}" if apart else ""
    above = f"above {max(near):.3g}" if near else ""
    return " and ".join(filter(None, [above, below]))


def start(case: str) -> str:
    return "half a step back: " if case.endswith("half-step-back") and "usl" in case else ""


def further(reports: dict[str, list[dict]]) -> str:
    """The runs that isolate a cause, each with the original variant."""
    rows = []
    for code in CODES:
        for run in reports.get(code.name, []):
            if run["variant"] in code.further:
                [first, *_] = [old for old in reports[code.name] if old["suite"] == run["suite"]]
                rows.append([code.title, f"`{run['suite']}`", run["variant"],
                             cell(run), cell(first)])
    return table(["code", "suite", "further run", "result", "original result"], rows)


def gradients(reports: dict[str, list[dict]]) -> str:
    """Derivatives; parameters with the same results share a row."""
    rows: list[list[str]] = []
    for code in CODES:
        for run in reports.get(code.name, []):
            first = [code.title, run["variant"], f"`{run['suite']}`"]
            rest = derivative(run)
            if rows and rows[-1][:3] + rows[-1][4:] == first + rest:
                rows[-1][3] += f", {run['derivative_by']}"
            else:
                rows.append([*first, run["derivative_by"], *rest])
    return table(["code", "run", "suite", "derivative by", "difference of the value",
                  "orders of the Taylor remainder", "error of the derivative", "sweep", "verdict"],
                 rows)


def derivative(run: dict[str, str]) -> list[str]:
    """The checks of one derivative."""
    if not run["value_difference"]:
        return ["", "", "", "", f"{run['verdict']}: {run['reason']}"]
    orders = [float(order) for order in run["taylor_orders"].split()]
    taylor = f"{min(orders):.2f} to {max(orders):.2f} ({len(orders)})" if orders else "none"
    error = float(run["derivative_error"])
    order = "" if error > 1 else f"order {float(run['order']):.2f}; "
    return [f"{float(run['value_difference']):.0e}", taylor, f"{order}{error:.1e}", run["sweep"], run["verdict"]]


def write(rows: list[dict[str, str]]) -> None:
    """Puts the tables between their markers."""
    reports: dict[str, list[dict]] = {"own": []}
    of_gradients: dict[str, list[dict]] = {}
    for row in [row for row in rows if not row["release"]]:
        (of_gradients if row["derivative_by"] else reports).setdefault(row["code"], []).append(row)
    releases = {"releases": summary(rows), "changes": changes(rows),
                "panel-2d": panel("plane", rows), "panel-3d": panel("space", rows)}
    newest = {"plane": matrix(PLANE, reports), "space": matrix(SPACE, reports),
              "free-2d": matrix(FREE_2D, reports), "free-3d": matrix(FREE_3D, reports),
              "lagrangian": matrix(LAGRANGIAN, reports),
              "exact": matrix(EXACT, reports), "further": further(reports),
              "gradients": gradients(of_gradients)}
    for name, texts in {"atlas.md": releases, "atlas-newest.md": newest}.items():
        page = (DOCS / name).read_text()
        for table, text in texts.items():
            begin, end = f"<!-- {table} -->\n", f"<!-- end of {table} -->"
            head, rest = page.split(begin)
            page = head + begin + text + "\n" + end + rest.split(end)[1]
        (DOCS / name).write_text(page)
