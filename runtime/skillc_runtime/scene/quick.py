"""Reads large scenes that are in order, many times faster than `scene`, which tells what is wrong with all others."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import TypeAlias

import msgspec
import pyoxigraph as ox

from skillc_compiler.collecting import no_collection
from skillc_compiler.library.vocabulary import PropertyTerm, Vocabulary
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.scene.checks.classes import are_placed
from skillc_runtime.scene.checks.containment import circular
from skillc_runtime.scene.checks.data_sheets import unsuited
from skillc_runtime.scene.checks.frames import misplaced
from skillc_runtime.scene.checks.ineffective import is_ordinary, is_ordinary_class
from skillc_runtime.scene.checks.plausible import implausible
from skillc_runtime.scene.checks.required import incomplete
from skillc_runtime.scene.checks.surface_regions import astray
from skillc_runtime.scene.documents import BASE, Document
from skillc_runtime.scene.memory import Watch
from skillc_runtime.scene.standard_terms import is_misspelt
from skillc_runtime.scene.statements import (
    ANNOTATION,
    CLASS_DECLARATIONS,
    NAMED_INDIVIDUAL,
    SUBCLASS,
    is_remark,
    is_term_kind,
    terms_of,
    with_classes,
)
from skillc_runtime.store.literals import LiteralError, read
from skillc_runtime.world.state.bulk import Facts, state_of
from skillc_runtime.world.state.sound import is_sound
from skillc_runtime.world.state.terms import HAS_TEMPLATE, TEMPLATE
from skillc_runtime.world.state.values import Value, equal
from skillc_runtime.world.state.world_state import WorldState

AT_ONCE = 100_000
"""So many triples are sorted before the memory that is left is looked at."""

_Named: TypeAlias = dict[str, list[tuple[str, str]]]
"""Subject and object by predicate; the object is empty where it is a blank node."""
_Literals: TypeAlias = dict[str, list[tuple[str, ox.Literal]]]


class _OutOfOrder(Exception):
    """Something in the texts is wrong, or too unusual to be understood here."""


@dataclass(slots=True)
class _Said:
    """What texts say, by predicate."""

    named: _Named = field(default_factory=lambda: defaultdict(list))
    literal: _Literals = field(default_factory=lambda: defaultdict(list))
    prefixes: dict[str, str] = field(default_factory=dict)
    types_first: int = 0
    """How many classes of things the first text states."""
    unnamed: bool = False
    """Whether anything without a name, or a statement about a statement, was said so far."""


def quick_world(documents: Sequence[Document], vocabulary: Vocabulary) -> WorldState | None:
    """Return the world of Turtle documents, None where something is wrong with them, or may be.

    The first one must say of something what it is. NoRoom when the machine has too little memory for them.
    """
    with no_collection():
        try:
            said = _said(documents, vocabulary)
            vocabulary = _own(said, vocabulary)
            state = state_of(vocabulary, _facts(said, vocabulary))
        except (_OutOfOrder, SyntaxError, LiteralError, UnicodeEncodeError):
            return None
        rules = (circular, incomplete, implausible, unsuited, misplaced, astray)
        in_order = is_sound(state) and not any(any(rule(state)) for rule in rules)
        return state if in_order else None


def _said(documents: Iterable[Document], vocabulary: Vocabulary) -> _Said:
    said, names, watch = _Said(), dict[str, str](), Watch()
    for place, document in enumerate(documents):
        parser = ox.parse(document.text.encode(), format=ox.RdfFormat.TURTLE, base_iri=BASE)
        while _sort(islice(parser, AT_ONCE), vocabulary.aliases, names, said):
            watch.look()
        if place == 0:
            _refuse_unusual(said, vocabulary)
            said.types_first = len(said.named[RDF_TYPE])
        for prefix, base in parser.prefixes.items():
            if vocabulary.namespaces.get(prefix, base) != base and base not in vocabulary.namespaces.values():
                raise _OutOfOrder  # it may be misspelt
            if prefix:
                said.prefixes.setdefault(prefix, base)
    return said


def _sort(triples: Iterable[ox.Quad], aliases: dict[str, str], names: dict[str, str], said: _Said) -> bool:
    """Sort triples by predicate, return whether there were any; each IRI is one string, however often it is written."""
    named, literal, known, each = said.named, said.literal, names.setdefault, None
    for each in triples:
        subject, object_, predicate = each.subject, each.object, each.predicate.value
        predicate = aliases.get(predicate, predicate)
        name = known(value, value) if isinstance(subject, ox.NamedNode) and (value := subject.value) else ""
        if isinstance(object_, ox.Literal):
            literal[predicate].append((name, object_))
        elif isinstance(object_, ox.NamedNode):
            value = object_.value
            value = aliases.get(value, value)
            named[predicate].append((name, known(value, value)))
        else:
            named[predicate].append((name, ""))
            said.unnamed = True
        if not name:
            said.unnamed = True
    return each is not None


def _refuse_unusual(said: _Said, vocabulary: Vocabulary) -> None:
    """Leave a text to the careful reader that says more than facts about individuals, and something about classes."""
    terms = terms_of(vocabulary)
    classes = {cls for _, cls in said.named[RDF_TYPE]}
    subjects = (name for part in (said.named, said.literal) for pairs in part.values() for name, _ in pairs)
    if (
        said.unnamed
        or not all(map(is_ordinary, said.named.keys() | said.literal.keys()))
        or not all(map(is_ordinary_class, classes))
        or any(name in terms for name in subjects)
    ):
        raise _OutOfOrder


def _own(said: _Said, vocabulary: Vocabulary) -> Vocabulary:
    """Return the vocabulary with the classes and prefixes of the texts."""
    types = said.named[RDF_TYPE]
    declared = {name for name, cls in types if cls in CLASS_DECLARATIONS}
    extended = msgspec.structs.replace(vocabulary, prefixes={**said.prefixes, **vocabulary.prefixes})
    extended = with_classes(extended, declared - {""}, said.named[SUBCLASS])
    if not are_placed(extended.classes.keys() - vocabulary.classes.keys(), extended):
        raise _OutOfOrder
    classes = {cls for _, cls in types}
    if any(map(is_misspelt, classes | said.named.keys() | said.literal.keys())):
        raise _OutOfOrder
    if any(cls in extended.classes for name, cls in types if not name):
        raise _OutOfOrder
    return extended


def _facts(said: _Said, vocabulary: Vocabulary) -> Facts:
    types = said.named[RDF_TYPE]
    kinds = {cls for cls in {cls for _, cls in types} if is_term_kind(cls)}
    terms = terms_of(vocabulary) | {name for name, cls in types if cls in kinds} | {""}
    notes = {name for name, cls in types if cls == ANNOTATION} - vocabulary.properties.keys()
    passed = notes | {TEMPLATE, HAS_TEMPLATE, RDF_TYPE}
    related: dict[str, list[tuple[str, str]]] = {}
    valued: dict[str, dict[str, Value | None]] = {}
    for predicate in (said.named.keys() | said.literal.keys()) - passed:
        if is_remark(predicate):
            continue
        pairs = [pair for pair in said.named.get(predicate, ()) if pair[0] not in terms]
        literals = [pair for pair in said.literal.get(predicate, ()) if pair[0] not in terms]
        if predicate in vocabulary.properties and not pairs:
            valued[predicate] = _values(literals, vocabulary.properties[predicate])
        elif predicate in vocabulary.relations and not literals:
            related[predicate] = pairs
        elif pairs or literals:
            raise _OutOfOrder
    return Facts(_classes(said, terms, vocabulary), related, valued)


def _classes(said: _Said, terms: set[str], vocabulary: Vocabulary) -> dict[str, tuple[str, ...]]:
    """Return the classes of each individual."""
    if any(name not in terms for name, _ in said.literal.get(RDF_TYPE, ())):
        raise _OutOfOrder
    found: dict[str, tuple[str, ...]] = {}
    for name, cls in said.named[RDF_TYPE]:
        if name not in terms and cls != NAMED_INDIVIDUAL:
            if cls not in vocabulary.ancestors:
                raise _OutOfOrder
            found[name] = (*found[name], cls) if name in found else (cls,)
    if not any(name in found for name, _ in said.named[RDF_TYPE][: said.types_first]):
        raise _OutOfOrder
    if any(name not in terms and name not in found for name, _ in said.named[RDF_TYPE]):
        raise _OutOfOrder  # it is of no class
    return found


def _values(literals: Iterable[tuple[str, ox.Literal]], term: PropertyTerm) -> dict[str, Value | None]:
    found: dict[str, Value | None] = {}
    for individual, literal in literals:
        if literal.language is not None:
            raise _OutOfOrder  # it has no effect, which is told
        value = read(literal, term)
        before = found.get(individual)
        if before is None:
            found[individual] = value if term.functional else (value,)
        elif not term.functional and isinstance(before, tuple):
            if not any(equal(value, each) for each in before):
                found[individual] = (*before, value)
        elif not equal(value, before):
            raise _OutOfOrder
    return found
