"""Checks whether a value fits a parameter: its type, class and range."""

from __future__ import annotations

from skillc_model.format_type import format_type
from skillc_model.rounding import is_above
from skillc_model.skills import Parameter
from skillc_rdf.vocabulary.types import THING, ClassType, DirectionType, ValueType, Vocabulary, local_name
from skillc_runtime.motion.arrays import np
from skillc_runtime.world.state.consistency.value_types import is_of_type
from skillc_runtime.world.state.labels.labelled_text import format_value
from skillc_runtime.world.state.labels.labelling import label_value
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.vectors import is_vector
from skillc_runtime.world.state.world_state import WorldState


def check_value(parameter: Parameter, value: Value, state: WorldState) -> str | None:
    """Return why the value does not fit the parameter, None if it does."""
    vocabulary = state.vocabulary
    if not is_of_type(value, parameter.type, state):
        return f"needs {_format_type(parameter.type, vocabulary)}, {_describe_value(value, parameter.type, state)}"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _check_range(parameter, float(value), vocabulary)
    return None


def _check_range(parameter: Parameter, value: float, vocabulary: Vocabulary) -> str | None:
    def text(number: float) -> str:
        return format_value(label_value(number, parameter.type, vocabulary))

    if parameter.low is not None and is_above(parameter.low, value):
        return f"{text(value)} is below {text(parameter.low)}, the minimum"
    if parameter.high is not None and is_above(value, parameter.high):
        return f"{text(value)} is above {text(parameter.high)}, the maximum"
    return None


def _describe_value(value: Value, type_: ValueType, state: WorldState) -> str:
    """Describe a value: an individual by its most specific classes."""
    text = format_value(label_value(value, type_, state.vocabulary))
    if isinstance(type_, DirectionType) and is_vector(value):
        return f"not {text}, whose length is {np.linalg.norm(value):g}"
    if not (isinstance(type_, ClassType) and isinstance(value, str)):
        return f"not {text}"
    if value not in state.individuals:
        return f"{text} is not in the world model"
    return (
        f"{text} is {' and '.join(f'a {state.vocabulary.short(cls)}' for cls in _most_specific_classes(value, state))}"
    )


def _most_specific_classes(individual: str, state: WorldState) -> list[str]:
    types = state.types(individual)
    above = {ancestor for cls in types for ancestor in state.vocabulary.ancestors.get(cls, ()) if ancestor != cls}
    return sorted(set(types) - above) or [THING]


def _format_type(type_: ValueType, vocabulary: Vocabulary) -> str:
    return local_name(type_.iri) if isinstance(type_, ClassType) else format_type(type_, vocabulary)
