"""The tables of docs/atlas.md, from the reports."""

from __future__ import annotations

import json
from pathlib import Path

from plan import CODES, EXACT, LAGRANGIAN, PLANE, SPACE, own_cases

PAGE = Path(__file__).resolve().parent.parent.parent / "docs" / "atlas.md"


def cell(run: dict) -> str:
    """Order with its interval and the verdict; for a translation, the largest error."""
    if run["lacks"]:
        return "not applicable (" + "; ".join(run["lacks"]) + ")"
    errors = [float(level["error"]) for level in run["levels"]]
    if run["verdict"] == "failed":
        broken = [str(level["cells"]) for level in run["levels"] if level["failure"]]
        return f"failed with {' and '.join(broken)} cells"
    if run["suite"].startswith("translating-block"):
        return f"error {max(errors):.1e}"
    if max(errors) < 1e-12:
        return f"error {max(errors):.0e}"
    order = run["observed_order"]
    interval = order and f"{order['value']:.2f} [{order['low']:.2f}, {order['high']:.2f}] "
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
                rows[-1][3] += f", {run['parameter']}"
            else:
                rows.append([*first, run["parameter"], *rest])
    return table(["code", "run", "suite", "derivative by", "difference of the value",
                  "orders of the Taylor remainder", "error of the derivative", "sweep", "verdict"],
                 rows)


def derivative(run: dict) -> list[str]:
    """The checks of one derivative."""
    found = run["gradient"]
    if not found:
        return ["", "", "", "", f"{run['verdict']}: {run['reason']}"]
    value = abs(found["reported_value"] / found["value"] - 1)
    orders = [level["order"] for level in found["taylor"] if level["order"] is not None]
    taylor = f"{min(orders):.2f} to {max(orders):.2f} ({len(orders)})" if orders else "none"
    last = found["levels"][-1]
    error = abs(last["error"] / last["exact"])
    order = "" if error > 1 else f"order {found['order']:.2f}; "
    sweep = found["sweep"]
    swept = sweep and f"share {sweep['share']:.4g}, {len(sweep['jumps']) or 'no'} jumps"
    return [f"{value:.0e}", taylor, f"{order}{error:.1e}", swept or "", run["verdict"]]


def write(folder: Path) -> None:
    """Puts the tables between their markers."""
    files = {file.stem: json.loads(file.read_text()) for file in folder.glob("*.json")}
    reports = {name: file["runs"] for name, file in files.items()}
    of_gradients = {name: file.get("gradients", []) for name, file in files.items()}
    page = PAGE.read_text()
    for name, text in [("plane", matrix(PLANE, reports)), ("space", matrix(SPACE, reports)),
                       ("lagrangian", matrix(LAGRANGIAN, reports)),
                       ("exact", matrix(EXACT, reports)), ("further", further(reports)),
                       ("gradients", gradients(of_gradients))]:
        begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
        head, rest = page.split(begin)
        page = head + begin + text + "\n" + end + rest.split(end)[1]
    PAGE.write_text(page)
