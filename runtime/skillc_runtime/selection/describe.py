"""Values and parameters in the words of a message."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_compiler.library.skills import Parameter
from skillc_compiler.library.vocabulary import ClassType, ListType, NumberType, ValueType, VectorType, Vocabulary
from skillc_compiler.library.words import SI_UNITS, quantity_text
from skillc_runtime.world.state.values import Value, show


def text_of(value: Value, type_: ValueType, vocabulary: Vocabulary) -> str:
    """Return a value as an author would write it: individuals by short name, numbers with their SI unit."""
    if isinstance(type_, ClassType) and isinstance(value, str):
        return vocabulary.short(value)
    if isinstance(type_, NumberType) and isinstance(value, int | float) and not isinstance(value, bool):
        return quantity_text(value, type_)
    if isinstance(type_, VectorType):
        return f"{show(value)} {SI_UNITS.get(type_.dimension, '')}".strip()
    if isinstance(type_, ListType) and isinstance(value, tuple) and len(value) > 3:
        return f"{len(value)} values"
    return show(value)


def bindings_text(
    bindings: Mapping[str, Value], parameters: Sequence[Parameter], vocabulary: Vocabulary
) -> dict[str, str]:
    """Return each bound parameter with its value as text, in the order of the parameters."""
    return {
        parameter.name: text_of(bindings[parameter.name], parameter.type, vocabulary)
        for parameter in parameters
        if parameter.name in bindings
    }
