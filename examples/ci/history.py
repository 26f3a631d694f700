"""Plots observed orders and finest errors over the commits of a solver, as one HTML page.

    python3 history.py results history.html

The folder has one report of `mpm-verify run --format json` for each commit; files are shown in the
order of their names. docs/compare.md explains how CI keeps them. Needs matplotlib.
"""

import html
import io
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)


def history(folder):
    """Returns for each `suite::case` the pairs of file number and (order, finest error)."""
    files = sorted(Path(folder).glob("*.json"))
    points = {}
    for number, file in enumerate(files):
        for suite in json.loads(file.read_text(encoding="utf-8"))["suites"]:
            for case in suite["cases"]:
                levels = case.get("levels") or []
                if not levels:
                    continue
                order = (case.get("observed_order") or {}).get("value")
                error = levels[-1]["judged"]
                values = [value if isinstance(value, float) else None for value in (order, error)]
                points.setdefault(f"{suite['suite']}::{case['case']}", []).append((number, values))
    return [file.stem for file in files], points


def figure(names, points, suite):
    """Returns the SVG of one suite: orders above, errors below."""
    drawing, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(7, 5))
    for case, pairs in sorted(points.items()):
        label = case.split("::", 1)[1]
        for axis, place in ((above, 0), (below, 1)):
            known = [(n, values[place]) for n, values in pairs if values[place] is not None]
            axis.plot([n for n, _ in known], [v for _, v in known], marker="o", label=label)
    above.set_ylabel("observed order")
    below.set_ylabel("finest error")
    below.set_yscale("log")
    # Differences at the level of rounding are not to fill the axes.
    low, high = above.get_ylim()
    above.set_ylim(min(low, (low + high) / 2 - 0.2), max(high, (low + high) / 2 + 0.2))
    low, high = below.get_ylim()
    below.set_ylim(min(low, (low * high) ** 0.5 / 2), max(high, (low * high) ** 0.5 * 2))
    below.set_xticks(range(len(names)), names, rotation=60, ha="right", fontsize=7)
    above.set_title(suite)
    above.legend(fontsize=7)
    drawing.tight_layout()
    text = io.StringIO()
    drawing.savefig(text, format="svg")
    plt.close(drawing)
    return text.getvalue()[text.getvalue().index("<svg"):]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    names, points = history(sys.argv[1])
    if not points:
        sys.exit(f"{sys.argv[1]}: no report with levels")
    suites = {}
    for case, pairs in points.items():
        suites.setdefault(case.split("::", 1)[0], {})[case] = pairs
    figures = [figure(names, cases, suite) for suite, cases in sorted(suites.items())]
    page = f"<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>History</title>\n" \
        f"<h1>{html.escape(names[0])} to {html.escape(names[-1])}</h1>\n" + "\n".join(figures)
    Path(sys.argv[2]).write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
