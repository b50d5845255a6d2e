"""Checks texts that name something, such as `posture: "home"`, which names a posture in an arm's data sheet.

A primitive declares them in `Primitive.text_names`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

import msgspec

from skillc_model import tree
from skillc_model.conditions import Variable
from skillc_model.skills import Compound, Declared, Implementation, Primitive, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_primitive
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

NamePath: TypeAlias = tuple[str, ...]
"""The relations to follow from an individual, then the property whose values are names."""


class UnknownTextName(msgspec.Struct, frozen=True):
    """A text that is none of the `known` values, sorted, of a property of `owner`, or of anything if that is None."""

    text: str
    property: str
    owner: str | None
    known: tuple[str, ...]

    def message(self, vocabulary: Vocabulary) -> str:
        """Return a message with the values that exist."""
        owner = "nothing" if self.owner is None else vocabulary.short(self.owner)
        has = f'{owner} has {"the" if self.owner is None else "no"} {vocabulary.short(self.property)} "{self.text}"'
        there = ", ".join(f'"{name}"' for name in self.known) or "none"
        return f"{has}; there is {there}" if self.owner is None else f"{has}; it has {there}"


def find_unknown_names(
    implementation: Implementation, bindings: Mapping[str, Value], state: WorldState, changing: frozenset[str]
) -> dict[str, UnknownTextName]:
    """Return by parameter the texts that name nothing for this primitive, if no skill changes the names.

    `bindings` are the known parameters. PrimitiveError if the primitive's class cannot be imported.
    """
    if not isinstance(implementation.body, Primitive):
        return {}
    found: dict[str, UnknownTextName] = {}
    for parameter, (start, *path) in import_primitive(implementation.body.python).text_names.items():
        text, owner = bindings.get(parameter), bindings.get(start)
        if not isinstance(text, str) or not is_fixed_path(tuple(path), state.vocabulary, changing):
            continue
        *relations, property_ = path
        one = owner if isinstance(owner, str) else None
        described = state.individuals if one is None else _follow_relations(one, relations, state)
        known = list_names(property_, described, state)
        if described and text not in known:
            found[parameter] = UnknownTextName(text, property_, one, known)
    return found


def list_names(property_: str, of: Iterable[str], state: WorldState) -> tuple[str, ...]:
    """Return the texts that are values of a property of some individuals, sorted."""
    stored = (state.value(individual, property_) for individual in of)
    values = (value for each in stored for value in (each if isinstance(each, tuple) else (each,)))
    return tuple(sorted({value for value in values if isinstance(value, str)}))


def find_name_paths(library: SkillLibrary, skill: str, parameter: str) -> frozenset[NamePath]:
    """Return the paths to the names that a text for this parameter must be one of, for all implementations.

    A compound passes its parameter on to a primitive. Empty if some implementation accepts any text.
    """
    return _paths_of_skill(library, skill, parameter, frozenset())


def find_name_paths_in_body(library: SkillLibrary, body: tree.Node, name: str) -> frozenset[NamePath]:
    """Return the paths to the names that a text must be one of which a body passes on as the variable `name`."""
    return _paths_of_body(library, body, name, frozenset())


def is_fixed_path(path: NamePath, vocabulary: Vocabulary, changing: frozenset[str]) -> bool:
    """Whether the vocabulary has all terms of a path and no skill changes them."""
    *relations, property_ = path
    known = vocabulary.relations.keys() >= set(relations) and property_ in vocabulary.properties
    return known and changing.isdisjoint(path)


def _paths_of_skill(
    library: SkillLibrary, skill: str, parameter: str, enclosing: frozenset[str]
) -> frozenset[NamePath]:
    if skill in enclosing or skill not in library.skills:
        return frozenset()
    each = [
        _paths_of_implementation(library, one, parameter, enclosing | {skill})
        for one in library.implementations_of(skill)
    ]
    return frozenset[NamePath]().union(*each) if all(each) else frozenset()


def _paths_of_implementation(
    library: SkillLibrary, implementation: Implementation, parameter: str, enclosing: frozenset[str]
) -> frozenset[NamePath]:
    if isinstance(implementation.body, Compound):
        return _paths_of_body(library, implementation.body.node, parameter, enclosing)
    if isinstance(implementation.body, Declared):
        return frozenset()
    try:
        names = import_primitive(implementation.body.python).text_names
    except PrimitiveError:
        return frozenset()
    return frozenset((names[parameter][1:],)) if parameter in names else frozenset()


def _paths_of_body(library: SkillLibrary, body: tree.Node, name: str, enclosing: frozenset[str]) -> frozenset[NamePath]:
    passed = (
        _paths_of_skill(library, call.skill, parameter, enclosing)
        for call in find_calls(body)
        for parameter, argument in call.arguments.items()
        if argument == Variable(name)
    )
    return frozenset[NamePath]().union(*passed)


def _follow_relations(start: str, relations: Iterable[str], state: WorldState) -> frozenset[str]:
    """Return the individuals at the end of a chain of relations."""
    found = frozenset((start,))
    for relation in relations:
        found = frozenset(other for each in found for other in state.objects(each, relation))
    return found
