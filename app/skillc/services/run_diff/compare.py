"""Compares two recorded runs: what they were given, what they decided, how they ended, and what was measured."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import count
from typing import Any

import msgspec
import numpy as np

from skillc.contract.runs.run_diff import Difference, Leaf, Part, RunDiff
from skillc.services.run_diff.alignment import align
from skillc.services.run_diff.calls import (
    compare_choices,
    compare_durations,
    compare_outcomes,
    compare_plans,
    pair_calls,
)
from skillc.services.run_diff.difference import compare_mappings, find_difference
from skillc.services.run_diff.objective import compare_objectives
from skillc.services.run_diff.recorded import RecordedRunData
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.events import Disturbed, Requested, TaskStarted
from skillc_runtime.recording.known_facts import format_status
from skillc_runtime.recording.run_spec import RunRequest, TaskRequest
from skillc_runtime.world.state.labels.labelled import LabelledIri

DIGITS = 1e-8
"""Signals that differ by less than this part of their range are equal: CSV files have nine significant digits."""


def compare_signals(first: Mapping[str, Array], second: Mapping[str, Array]) -> Iterator[Difference]:
    """Yield the signals of both runs, samples (n,) by column, whose peaks or means differ.

    A peak is the greatest absolute value.
    """
    for name in first.keys() & second.keys():
        one, other = (values[np.isfinite(values)] for values in (first[name], second[name]))
        if not len(one) or not len(other):
            continue
        both = np.concatenate((one, other))
        range_ = float(np.max(both) - np.min(both))
        measures = {"peak": (_peak(one), _peak(other)), "mean": (float(np.mean(one)), float(np.mean(other)))}
        for what, pair in measures.items():
            size = abs(pair[0] - pair[1]) / range_ if range_ > 0.0 else 0.0
            if size > DIGITS:
                yield from find_difference("signals", f"{name} {what}", pair, size)


def _peak(values: Array) -> float:
    return float(np.max(np.abs(values)))


SETTINGS = (
    *(
        each
        for each in RunRequest.__struct_fields__
        if each not in (*TaskRequest.__struct_fields__, "step", "breakpoints")
    ),
    "reality",
)
"""How a run was to be done; what was to be done, and where it pauses, is compared as it was understood."""


def compare_runs(first: RecordedRunData, second: RecordedRunData) -> RunDiff:
    """Return in what two runs differ."""
    calls = pair_calls(first.history, second.history)
    about, same = _about_run(first.start), _about_run(second.start)
    requests = _list_requests(first), _list_requests(second)
    differences = (
        *compare_mappings("settings", about, same),
        *compare_objectives(first.start, second.start),
        *_compare_requests(*requests),
        *compare_plans(first.history, second.history),
        *compare_choices(calls.pairs),
        *find_difference("outcomes", "task", (_describe_end(first), _describe_end(second))),
        *compare_outcomes(calls),
        *_compare_measures(first.result, second.result),
        *_by_size([*_compare_time(first, second), *compare_durations(calls.pairs)]),
        *_by_size(compare_signals(first.signals or {}, second.signals or {})),
    )
    compared: dict[Part, int] = {
        "settings": len(about) + 1,
        "requests": max(map(len, requests)),
        "plan": min(len(each.history.attempts) for each in (first, second)),
        "choices": len(calls.pairs),
        "outcomes": len(calls.pairs) + 1,
        "measures": len(_list_works(first.result).keys() & _list_works(second.result).keys()),
        "times": len(calls.pairs) + 1,
        "signals": len((first.signals or {}).keys() & (second.signals or {})),
    }
    return RunDiff((first.name, second.name), compared, differences, tuple(_list_notes(first, second)))


def _about_run(start: TaskStarted) -> dict[str, Leaf]:
    """Return what a run was given at its start."""
    settings = {each: getattr(start.settings, each) for each in SETTINGS}
    return {
        "task": start.task,
        "minimise": start.minimise or None,
        "library": start.library,
        "library hash": start.hash[:12],
        "scene": start.scene,
        "backend": start.backend,
        "seed": start.seed,
        **settings,
        "breakpoints": ", ".join(start.breakpoints) or None,
        "begins with a pause": start.stepped,
    }


def _list_requests(run: RecordedRunData) -> list[str]:
    return [_describe_request(event) for event in run.events if isinstance(event, Requested | Disturbed)]


def _compare_requests(first: list[str], second: list[str]) -> tuple[Difference, ...]:
    """Return the first request that differs: those after it depend on what it did."""
    pairs = enumerate(align(first, second, lambda each: each, lambda each: each.partition(" ")[0]), 1)
    return next(
        (found for number, pair in pairs if (found := find_difference("requests", f"request {number}", pair))), ()
    )


def _describe_request(event: Requested | Disturbed) -> str:
    wanted = msgspec.to_builtins(event.command if isinstance(event, Requested) else event.disturbance)
    fields = ", ".join(f"{name}: {value}" for name, value in wanted.items() if name != "type")
    refused = ", refused" if isinstance(event, Requested) and event.refused else ""
    return f"{wanted['type']} in tick {event.tick}{f' ({fields})' if fields else ''}{refused}"


def _describe_end(run: RecordedRunData) -> str:
    if not run.history.status:
        return "not ended as far as it is recorded"
    status = format_status(run.history.status, run.history.verified, run.history.false_claims)
    return f"{status}: {run.result.failure}" if run.result.failure else status


def _compare_time(first: RecordedRunData, second: RecordedRunData) -> tuple[Difference, ...]:
    ends = round(first.history.last, 6), round(second.history.last, 6)
    return find_difference("times", "whole run", ends, abs(ends[0] - ends[1]))


def _compare_measures(first: TaskResult, second: TaskResult) -> Iterator[Difference]:
    """Yield the numbers of the pieces of work that differ; work that one run has not done is one difference."""
    works, others = _list_works(first), _list_works(second)
    for name in dict.fromkeys((*works, *others)):
        if name in works and name in others:
            yield from compare_mappings("measures", works[name], others[name])
        else:
            yield from find_difference(
                "measures", name, ("done" if name in works else None, "done" if name in others else None)
            )


def _list_works(result: TaskResult) -> dict[str, dict[str, Leaf]]:
    """Return the numbers of the pieces of work of a run, by what was worked on, as its report has them."""
    found: dict[str, dict[str, Leaf]] = {}
    for kind, works in (("wiping", result.wipings), ("work", result.works), ("placement", result.placements)):
        for work in works:
            name = _name_work(kind, work, found)
            found[name] = {f"{name}: {field}": each for field, each in _list_numbers(msgspec.to_builtins(work))}
    return found


def _name_work(kind: str, work: msgspec.Struct, others: Collection[str]) -> str:
    """Return the kind of a piece of work and what it was done on, with a number if it was done before."""
    values = (getattr(work, each) for each in work.__struct_fields__)
    on = next((f" of {value.label}" for value in values if isinstance(value, LabelledIri)), "")
    name = f"{work.__struct_config__.tag or kind}{on}"
    names = (name if number == 1 else f"{name}, {number}" for number in count(1))
    return next(each for each in names if each not in others)


def _list_numbers(value: Mapping[str, Any]) -> Iterator[tuple[str, Leaf]]:
    for name, each in value.items():
        if isinstance(each, int | float):
            yield name, each
        elif isinstance(each, list) and all(isinstance(number, float) for number in each):
            yield from ((f"{name}[{index}]", number) for index, number in enumerate(each))


def _by_size(found: Iterable[Difference]) -> list[Difference]:
    return sorted(found, key=lambda each: (-each.size, each.what))


def _list_notes(first: RecordedRunData, second: RecordedRunData) -> Iterator[str]:
    for run in (first, second):
        if run.signals is None:
            yield f"{run.name} has no signals to compare; `skillc run --out` records them in recording.mcap"
    if first.signals is not None and second.signals is not None:
        for run, names in (
            (first, first.signals.keys() - second.signals),
            (second, second.signals.keys() - first.signals),
        ):
            if names:
                yield f"{len(names)} signals are in {run.name} only"
