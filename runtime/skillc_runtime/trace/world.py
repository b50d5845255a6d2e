"""Changes of the world as lines of text."""

from __future__ import annotations

from typing import assert_never

from skillc_compiler.library.vocabulary import Vocabulary, local_name
from skillc_runtime.trace.events import WorldChanged
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.model import ChangeEvent
from skillc_runtime.world.state.values import show


def world_changed(event: ChangeEvent, time: float) -> WorldChanged:
    """Return a change of the world model as an event of the trace; `time` in seconds of the cell's clock."""
    changes = tuple(change_text(change, event.after.vocabulary) for change in event.changes)
    return WorldChanged(time=time, origin=event.origin, changes=changes, known=event.known)


def change_text(change: Change, vocabulary: Vocabulary) -> str:
    """Return a change in the words of the language, as `lab:Gripper-1 contain lab:Eraser-1`."""
    short = vocabulary.short
    match change:
        case AddIndividual(individual, types):
            return f"new: {short(individual)} is a {', '.join(short(cls) for cls in types)}"
        case RemoveIndividual(individual):
            return f"gone: {short(individual)}"
        case AddRelation(subject, relation, object_):
            return f"{short(subject)} {local_name(relation)} {short(object_)}"
        case RemoveRelation(subject, relation, object_):
            return f"not {short(subject)} {local_name(relation)} {short(object_)}"
        case SetProperty(individual, property_, value):
            return f"{short(individual)}.{local_name(property_)} == {show(value)}"
        case ClearProperty(individual, property_):
            return f"not {short(individual)} has {local_name(property_)}"
        case _:
            assert_never(change)
