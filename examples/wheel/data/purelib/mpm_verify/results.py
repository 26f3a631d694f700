"""Results of `mpm-verify run --format json` as plain Python data.

    from mpm_verify import results

    report = results.load("reports/report.json")
    for row in results.rows(report):
        print(row["suite"], row["case"], row["cells"], row["judged"])
    frame = results.to_dataframe(report)  # needs pandas

docs/json.md and docs/columns.md of mpm-verify explain the keys.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Union

if TYPE_CHECKING:
    import pandas

Report = dict[str, Any]
Row = dict[str, Any]

# The JSON has these strings in place of numbers that are not finite.
_NOT_FINITE = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}
# Keys whose values are names or sentences. A case may be called `inf`.
_TEXTS = {"suite", "case", "title", "about", "because", "reason", "failure", "source"}
_NESTED = ("errors", "drift")


def load(source: Union[str, os.PathLike[str]]) -> Report:
    """Returns the report in a file, or in a string that contains the JSON document itself.

    Strings that stand for numbers (`"nan"`, `"inf"`, `"-inf"`) become floats. Raises `ValueError`
    if the document is not a report of `mpm-verify run`."""
    text = source if isinstance(source, str) and source.lstrip().startswith("{") else \
        Path(source).read_text(encoding="utf-8")
    report = _with_floats(json.loads(text))
    suites = report.get("suites") if isinstance(report, dict) else None
    if not isinstance(report, dict) or not isinstance(suites, list) \
            or not all(isinstance(suite, dict) and "cases" in suite for suite in suites):
        raise ValueError("this is not the JSON of `mpm-verify run --format json`")
    return report


def cases(report: Report) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Returns each case of the report, as a pair of its suite and the case."""
    for suite in report["suites"]:
        for case in suite["cases"]:
            yield suite, case


def rows(report: Report) -> list[Row]:
    """Returns one dictionary for each level of each case, from the coarsest to the finest level.

    The keys are those of a level in the JSON, with `errors` and `drift` spread over columns such
    as `error_linf` and `drift_mass`. Each row repeats `suite`, `case`, `subject`, `verdict`,
    `passed` and `result` of the case, and the observed order with its 95 % interval
    (`observed_order`, `order_low`, `order_high`; None without an order). `level` counts from 0. A
    case without levels, such as one that is not applicable, has no row."""
    table: list[Row] = []
    for suite, case in cases(report):
        order = case.get("observed_order") or {}
        shared = {
            "suite": suite["suite"],
            "case": case["case"],
            "subject": case.get("subject"),
            "verdict": case["verdict"],
            "passed": case["passed"],
            "result": case.get("result"),
            "observed_order": order.get("value"),
            "order_low": order.get("low"),
            "order_high": order.get("high"),
        }
        for number, level in enumerate(case.get("levels") or []):
            row = {**shared, "level": number}
            row.update({key: value for key, value in level.items() if key not in _NESTED})
            for prefix, key in (("error", "errors"), ("drift", "drift")):
                for name, value in (level.get(key) or {}).items():
                    row[f"{prefix}_{name}"] = value
            table.append(row)
    return table


def to_dataframe(report: Report) -> pandas.DataFrame:
    """Returns the rows of `rows` as a pandas DataFrame. Raises `ImportError` without pandas."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_dataframe needs pandas: pip install pandas") from error
    return pandas.DataFrame(rows(report))


def _with_floats(value: Any, key: str = "") -> Any:
    if isinstance(value, dict):
        return {name: _with_floats(inner, name) for name, inner in value.items()}
    if isinstance(value, list):
        return [_with_floats(inner, key) for inner in value]
    if isinstance(value, str) and key not in _TEXTS:
        return _NOT_FINITE.get(value, value)
    return value
