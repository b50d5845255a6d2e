"""Writes values into texts, with their units."""

from __future__ import annotations

import re
from collections.abc import Mapping

from skillc_model.conditions import Message
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.eval.bindings import Bindings, ExpressionFunction
from skillc_runtime.world.state.labels.labelled import LabelledValue
from skillc_runtime.world.state.labels.labelled_text import format_value
from skillc_runtime.world.state.labels.labelling import label_value
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

_WRITTEN = re.compile(r"\{\{|\}\}|\{(?P<value>[^{}]*)\}")
"""What stands between braces in a text, a value, and braces themselves."""


def compile_message(message: Message, values: Mapping[str, ExpressionFunction]) -> ExpressionFunction:
    """Return a function that computes a text; it returns None if one of the values in it is missing."""

    def compute(state: WorldState, bindings: Bindings) -> Value | None:
        found = {name: value(state, bindings) for name, value in values.items()}
        known = {name: value for name, value in found.items() if value is not None}
        if len(known) < len(found):
            return None
        return write_values(message, label_values(message, known, state.vocabulary))

    return compute


def label_values(message: Message, values: Mapping[str, Value], vocabulary: Vocabulary) -> dict[str, LabelledValue]:
    """Return the values in a text with units and short names."""
    return {each.name: label_value(values[each.name], each.type, vocabulary) for each in message.values}


def write_values(message: Message, values: Mapping[str, LabelledValue]) -> str:
    """Return a text with values in it; a text among them stands without quotes."""
    shown = {name: each if isinstance(each, str) else format_value(each) for name, each in values.items()}

    def write(found: re.Match[str]) -> str:
        return shown[found["value"]] if found.lastgroup == "value" else found.group()[0]

    return _WRITTEN.sub(write, message.text)
