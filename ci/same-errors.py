"""Whether two runs have the same errors on every level, to 1e-8 of the largest.

    python3 ci/same-errors.py OURS.json CASE THEIRS.json
"""

import json
import sys

TOLERANCE = 1e-8

ours, name, theirs = sys.argv[1:]


def cases(file):
    with open(file) as document:
        return json.load(document)["suites"][0]["cases"]


ours = next(case for case in cases(ours) if case["case"] == name)
[theirs] = cases(theirs)
if not theirs["levels"]:
    sys.exit(f"{theirs['case']}: {theirs['reason']}")


def is_number(level):
    # Numbers that are not finite are strings.
    return isinstance(level["judged"], float)


largest = max(level["judged"] for level in ours["levels"] if is_number(level))
worst = 0.0
for a, b in zip(ours["levels"], theirs["levels"], strict=True):
    failed = [not is_number(level) for level in (a, b)]
    if any(failed):
        # If the method itself fails on a level, it must fail for both solvers.
        if not all(failed):
            sys.exit(f"{theirs['case']}, {a['cells']} cells: one failed: {a['failure']}, {b['failure']}")
        continue
    off = abs(a["judged"] - b["judged"]) / largest
    if not off <= TOLERANCE:
        sys.exit(f"{theirs['case']}, {a['cells']} cells: {b['judged']}, and ours is {a['judged']}")
    worst = max(worst, off)
print(f"{theirs['case']} as {name}: errors differ by {worst:.1e} of the largest")
