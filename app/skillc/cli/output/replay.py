"""Formats what the check of a recorded run found."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from skillc.cli.layout import Row, TerminalPage
from skillc.services.replaying.check import DifferentEvent, ReplayCheck


def format_check(found: ReplayCheck, page: TerminalPage) -> list[str]:
    """Return as lines whether the events are possible, and whether they were the same when the run was repeated."""
    return [*_describe_possible(found, page), *_describe_repetition(found, page)]


def _describe_possible(found: ReplayCheck, page: TerminalPage) -> list[str]:
    if found.impossible is not None:
        return page.wrap(found.impossible, "bad", hanging="  ")
    checked = "each possible after those before it" if found.checked else "not checked"
    return page.wrap(f"{found.events} events, {checked}")


def _describe_repetition(found: ReplayCheck, page: TerminalPage) -> Iterator[str]:
    if found.difference is not None:
        event = _name_event(found.difference)
        yield from page.wrap(
            f"repeated: {event} differs; the {found.difference.number - 1} before it are the same", "bad"
        )
        yield from page.table(("", "recorded", "repeated"), list(_list_fields(found.difference)))
    elif found.repeated is not None:
        yield from page.wrap(f"repeated: {found.repeated} events, the same but for wall times")
    else:
        yield from page.wrap(f"not repeated: {found.note}", hanging="  ")


def _name_event(different: DifferentEvent) -> str:
    event = different.recorded or different.repeated or {}
    return f"event {different.number}, {event.get('type')} at {event.get('time', 0.0):.2f} s,"


def _list_fields(different: DifferentEvent) -> Iterator[Row]:
    """Yield the fields that differ; of an event that one side does not have, all."""
    recorded, repeated = different.recorded or {}, different.repeated or {}
    for name in dict.fromkeys((*recorded, *repeated)):
        if recorded.get(name) != repeated.get(name):
            yield name, _format(recorded.get(name)), _format(repeated.get(name))


def _format(value: Any) -> str:
    return "-" if value is None else value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
