"""Texts that name something, as the text `posture: "home"` names a posture of an arm's data sheet.

A primitive declares them in `Primitive.text_names`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from skillc_compiler.library import tree
from skillc_compiler.library.conditions import Variable
from skillc_compiler.library.reading import walk
from skillc_compiler.library.skills import Implementation, Primitive, SkillLibrary
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_runtime.selection.python import PrimitiveError, primitive_class
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Path: TypeAlias = tuple[str, ...]
"""Relations to follow from an individual, and the property whose values are names."""


@dataclass(frozen=True, slots=True)
class Misnamed:
    """A text that names nothing: nothing that `owner` has, or nothing at all where `owner` is None, has this value.

    `known` are the values there are, sorted.
    """

    text: str
    property: str
    owner: str | None
    known: tuple[str, ...]

    def message(self, vocabulary: Vocabulary) -> str:
        """Say what does not exist, and what does."""
        owner = "nothing" if self.owner is None else vocabulary.short(self.owner)
        has = f'{owner} has {"the" if self.owner is None else "no"} {vocabulary.short(self.property)} "{self.text}"'
        there = ", ".join(f'"{name}"' for name in self.known) or "none"
        return f"{has}; there is {there}" if self.owner is None else f"{has}; it has {there}"


def misnamed(
    implementation: Implementation, bindings: Mapping[str, Value], state: WorldState, changing: frozenset[str]
) -> dict[str, Misnamed]:
    """Return by parameter the texts that name nothing for this primitive, as far as no skill changes what they name.

    `bindings` are the parameters that are known. PrimitiveError when the primitive's class cannot be had.
    """
    if not isinstance(implementation.body, Primitive):
        return {}
    found: dict[str, Misnamed] = {}
    for parameter, (start, *path) in primitive_class(implementation.body.python).text_names.items():
        text, owner = bindings.get(parameter), bindings.get(start)
        if not isinstance(text, str) or not is_fixed_path(tuple(path), state.vocabulary, changing):
            continue
        *relations, property_ = path
        one = owner if isinstance(owner, str) else None
        described = state.individuals if one is None else _reached(one, relations, state)
        known = known_names(property_, described, state)
        if described and text not in known:
            found[parameter] = Misnamed(text, property_, one, known)
    return found


def known_names(property_: str, of: Iterable[str], state: WorldState) -> tuple[str, ...]:
    """Return the texts that a property has for some individuals, sorted."""
    stored = (state.value(individual, property_) for individual in of)
    values = (value for each in stored for value in (each if isinstance(each, tuple) else (each,)))
    return tuple(sorted({value for value in values if isinstance(value, str)}))


def naming_paths(library: SkillLibrary, skill: str, parameter: str) -> frozenset[Path]:
    """Return the ways to the names of which a text for this parameter is one, whatever implementation is taken.

    A compound passes its parameter on to a primitive. Empty where some implementation takes any text.
    """
    return _naming(library, skill, parameter, frozenset())


def paths_named_by(library: SkillLibrary, body: tree.Node, name: str) -> frozenset[Path]:
    """Return the ways to the names of which a text is one that a body passes on under a name."""
    return _passed_on(library, body, name, frozenset())


def is_fixed_path(path: Path, vocabulary: Vocabulary, changing: frozenset[str]) -> bool:
    """Whether the vocabulary has all terms of a way and no skill changes them."""
    *relations, property_ = path
    known = vocabulary.relations.keys() >= set(relations) and property_ in vocabulary.properties
    return known and changing.isdisjoint(path)


def _naming(library: SkillLibrary, skill: str, parameter: str, around: frozenset[str]) -> frozenset[Path]:
    if skill in around or skill not in library.skills:
        return frozenset()
    each = [_named_by(library, one, parameter, around | {skill}) for one in library.implementations_of(skill)]
    return frozenset[Path]().union(*each) if all(each) else frozenset()


def _named_by(
    library: SkillLibrary, implementation: Implementation, parameter: str, around: frozenset[str]
) -> frozenset[Path]:
    if not isinstance(implementation.body, Primitive):
        return _passed_on(library, implementation.body.node, parameter, around)
    try:
        names = primitive_class(implementation.body.python).text_names
    except PrimitiveError:
        return frozenset()
    return frozenset((names[parameter][1:],)) if parameter in names else frozenset()


def _passed_on(library: SkillLibrary, body: tree.Node, name: str, around: frozenset[str]) -> frozenset[Path]:
    passed = (
        _naming(library, call.skill, parameter, around)
        for call in walk(body)
        if isinstance(call, tree.Call)
        for parameter, argument in call.arguments.items()
        if argument == Variable(name)
    )
    return frozenset[Path]().union(*passed)


def _reached(start: str, relations: Iterable[str], state: WorldState) -> frozenset[str]:
    """Return the individuals that a chain of relations leads to."""
    found = frozenset((start,))
    for relation in relations:
        found = frozenset(other for each in found for other in state.objects(each, relation))
    return found
