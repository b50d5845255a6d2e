"""The page about trials names terms and metrics that there are, and disturbances that there are."""

from __future__ import annotations

import re
from typing import get_args

from docs.pages import ROOT
from skillc_runtime.commands import _library
from skillc_runtime.trials.targets import METRICS
from skillc_runtime.trials.trial import Disturbance
from skillc_runtime.world.terms import SKILLC

PAGE = (ROOT / "docs/trials.md").read_text(encoding="utf-8")


def test_the_properties_of_the_page_are_in_the_vocabulary() -> None:
    named = set(re.findall(r"skillc:(\w+)", PAGE))
    assert len(named) > 7
    assert {SKILLC + name for name in named} <= _library.vocabulary().properties.keys()


def test_the_page_has_every_metric_with_its_target_and_every_disturbance() -> None:
    rows = dict(re.findall(r"^\| ([^|]+) \| ([^|]+) \|", PAGE, re.MULTILINE))
    for metric in METRICS:
        (said,) = [said for name, said in rows.items() if name.split(",")[0] == metric.name]
        target = "no target" if metric.target is None else f"{metric.target:g}"
        assert target in said or (metric.target == 0 and said == "never")
    assert all(f"| `{name}` |" in PAGE for name in get_args(Disturbance) if name != "none")
