"""The page about trials names terms and metrics that there are, and disturbances that there are."""

from __future__ import annotations

import re
from typing import get_args

from docs.pages import ROOT
from skillc.services.library import libraries
from skillc_runtime.evaluation.trials.targets import METRICS
from skillc_runtime.evaluation.trials.trial import TrialDisturbance
from skillc_runtime.world.state.terms import CONTACT, SKILLC

PAGE = (ROOT / "docs/trials.md").read_text(encoding="utf-8")


def test_the_properties_of_the_page_are_in_the_vocabulary() -> None:
    for prefix, namespace in (("skillc", SKILLC), ("contact", CONTACT)):
        named = set(re.findall(rf"{prefix}:(\w+)", PAGE))
        assert len(named) > 4
        assert {namespace + name for name in named} <= libraries.load_vocabulary().properties.keys()


def test_the_page_has_every_metric_with_its_target_and_every_disturbance() -> None:
    said = targets()
    assert len(said) == len(METRICS)
    for (kind, metrics), rows in zip(METRICS.items(), said, strict=True):
        own = metrics[: len(METRICS[kind]) - len(METRICS["wiping"])] if kind == "polishing" else metrics
        assert len(own) > 1
        for metric in own:
            target = "no target" if metric.target is None else f"{metric.target:g}"
            assert target in rows[metric.name] or (metric.target == 0 and rows[metric.name] == "never")
    assert all(f"| `{name}` |" in PAGE for name in get_args(TrialDisturbance) if name != "none")


def targets() -> list[dict[str, str]]:
    """Return what the page says of the metrics of each kind of work; a row with a name in front begins a kind."""
    kinds: list[dict[str, str]] = []
    table = PAGE.partition("target in every trial |\n|---|---|---|\n")[2].partition("\n\n")[0]
    for row in table.splitlines():
        kind, metric, target = (cell.strip() for cell in row.strip("|").split("|"))
        if kind:
            kinds.append({})
        kinds[-1][metric.split(",")[0]] = target
    return kinds
