"""What Schemathesis draws is often replaced by what exists, so that many requests are carried out."""

from __future__ import annotations

import os
from typing import Any

import schemathesis
from schemathesis import HookContext

NAMES = {
    "cell": "yard",
    "operation": os.environ.get("SKILLC_TEST_OPERATION", ""),
    "library": os.environ.get("SKILLC_TEST_LIBRARY", ""),
}
VALUES: dict[str, str | list[str] | dict[str, str]] = {
    "task": "carry",
    "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"},
    "goal": "lab:Goal contain lab:crate-2",
    "call": "Load(cart: lab:Cart-1, crate: lab:crate-1)",
    "sparql": "SELECT * { ?subject ?relation ?object } LIMIT 3",
    "edits": ["lab:Start contain lab:crate-1"],
    "breakpoints": ["Load"],
}
SHORT = 50
"""How long texts and lists may be that are replaced: longer ones may be too long on purpose."""
KEPT = 4
"""One of how many drawn values is kept."""


@schemathesis.hook
def map_path_parameters(_context: HookContext, drawn: dict[str, Any] | None) -> dict[str, Any] | None:
    """Replace most names in paths by those of what exists."""
    return drawn if drawn is None else {**drawn, **{each: NAMES[each] for each in _chosen(drawn) if each in NAMES}}


@schemathesis.hook
def map_query(_context: HookContext, drawn: dict[str, Any] | None) -> dict[str, Any] | None:
    """Replace most paths of files by that of one which exists."""
    return drawn if drawn is None or "path" not in _chosen(drawn) else {**drawn, "path": "yard.skill"}


@schemathesis.hook
def map_body(_context: HookContext, drawn: Any) -> Any:
    """Replace most values in bodies by valid ones, but none that is wrong on purpose; press no emergency stop.

    A cell in which it is pressed refuses everything. Systematic requests, for which this is not called, press it.
    """
    if not isinstance(drawn, dict):
        return drawn
    valid = {each for each in _chosen(drawn) if each in VALUES and _may_be_valid(drawn[each], VALUES[each])}
    released = {"pressed": False} if drawn.get("pressed") is True else {}
    return {**drawn, **{each: VALUES[each] for each in valid}, **released}


def _may_be_valid(drawn: Any, value: str | list[str] | dict[str, str]) -> bool:
    """Whether a value that was drawn is of the type of another one, and not long."""
    if not isinstance(drawn, type(value)) or not 0 < len(drawn) <= SHORT:
        return False
    parts = drawn.values() if isinstance(drawn, dict) else drawn
    return all(isinstance(each, str) and len(each) <= SHORT for each in parts)


def _chosen(drawn: dict[str, Any]) -> list[str]:
    """Return the keys whose values are to be replaced; the same draw has always the same ones."""
    return [each for number, each in enumerate(drawn) if (len(repr(drawn)) + number) % KEPT]
