"""Tests of `mpm_verify.results`. They need no `mpm-verify`."""

from __future__ import annotations

import json
import math

import pytest
from mpm_verify import results

LEVEL = {"cells": 5, "h": 5.0, "judged": 4e-2, "order": None, "failure": None,
         "errors": {"rms": 4e-2, "linf": "inf"}, "drift": {"mass": 0.0, "energy": "nan"}}
FINER = {**LEVEL, "cells": 10, "h": 2.5, "judged": 1e-2, "order": 2.0,
         "errors": {"rms": 1e-2, "linf": 3e-2}}
REPORT = {"suites": [{"suite": "bar", "cases": [
    {"case": "inf", "subject": "external", "verdict": "converging", "passed": True,
     "result": "pass", "observed_order": {"value": 2.0, "low": 1.9, "high": 2.1},
     "levels": [LEVEL, FINER]},
    {"case": "b", "subject": "external", "verdict": "not applicable", "passed": False,
     "result": "not applicable", "observed_order": None, "levels": []}]}]}


def test_a_file_and_its_text_load_alike(tmp_path) -> None:
    path = tmp_path / "report.json"
    path.write_text(json.dumps(REPORT, indent=2), encoding="utf-8")
    expected = str(results.load(json.dumps(REPORT)))
    assert str(results.load(path)) == str(results.load(str(path))) == expected


def test_strings_for_numbers_become_floats_and_names_stay() -> None:
    first, _ = results.rows(results.load(json.dumps(REPORT)))
    assert first["error_linf"] == math.inf
    assert math.isnan(first["drift_energy"])
    assert first["case"] == "inf"


def test_each_level_is_one_row() -> None:
    first, second = results.rows(results.load(json.dumps(REPORT)))
    assert (first["level"], second["level"]) == (0, 1)
    assert (second["suite"], second["cells"], second["error_rms"]) == ("bar", 10, 1e-2)
    assert (second["observed_order"], second["order_low"], second["order_high"]) == (2.0, 1.9, 2.1)
    assert "errors" not in second and "drift" not in second


@pytest.mark.parametrize("text", ["{}", '{"suites": 1}', '{"suites": [1]}', '{"suites": [{}]}'])
def test_another_document_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="not the JSON"):
        results.load(text)


def test_a_data_frame_has_the_rows() -> None:
    pytest.importorskip("pandas")
    frame = results.to_dataframe(results.load(json.dumps(REPORT)))
    assert list(frame["judged"]) == [4e-2, 1e-2]
    assert frame["h"].iloc[1] == 2.5
