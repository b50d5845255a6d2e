"""From understood `verify` lines to those of the library."""

from __future__ import annotations

from skillc_compiler.library import properties as library
from skillc_compiler.logic.folding import fold, fold_condition
from skillc_compiler.program.typed import Event, Property, position


def verified(understood: Property) -> library.Property:
    """Return a property."""
    return library.Property(
        pattern=understood.pattern,
        first=_event(understood.first),
        second=_event(understood.second) if understood.second else None,
        text=understood.text,
        source=position(understood.span),
    )


def _event(understood: Event) -> library.Event:
    if understood.clause is not None:
        return library.Is(fold_condition(understood.clause.meaning))
    if understood.measured is not None:
        limit = fold(understood.measured.limit.meaning)
        return library.Measures("force", understood.measured.operator, limit)
    assert understood.skill is not None, "an event is a skill, a condition or a force"
    return library.Runs(understood.skill)
