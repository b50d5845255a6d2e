"""Finds statements of a scene that have no effect, so that nothing is ignored silently."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence, Set

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import Node, Statement
from skillc_rdf.turtle.terms import OWL, RDF, RDF_TYPE
from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.types import THING, Vocabulary
from skillc_runtime.scene.standard_terms import is_misspelt
from skillc_runtime.scene.statements import (
    ANNOTATION,
    CLASS_DECLARATIONS,
    NAMED_INDIVIDUAL,
    SUBCLASS,
    iri_of,
    is_annotation,
    is_remark,
    is_term_kind,
    terms_of,
)
from skillc_runtime.world.state.terms import HAS_TEMPLATE, TEMPLATE

NAME = "no-effect"
SHOWN = 5
"""The maximum number of labels for one kind of statement."""
NOTHING = f"{OWL}Nothing"
DECLARATIONS = frozenset({*CLASS_DECLARATIONS, ANNOTATION, TEMPLATE, f"{OWL}Ontology"})
"""Classes whose instances are understood but are not individuals."""
TYPES_ELSEWHERE = DECLARATIONS | {NOTHING, NAMED_INDIVIDUAL, THING}
ELSEWHERE = frozenset({HAS_TEMPLATE, TEMPLATE, f"{OWL}sameAs", f"{OWL}differentFrom"})
"""Predicates that other checks report."""
_BY_CLASS_ALONE = "a scene declares classes alone; declare this in a .skill file or in an ontology"
_HELP = {
    f"{OWL}ObjectProperty": _BY_CLASS_ALONE,
    f"{OWL}DatatypeProperty": _BY_CLASS_ALONE,
    f"{OWL}imports": "nothing is fetched: a folder of ontologies is named with --ontology",
    SUBCLASS: "a class that the vocabulary has is changed in its ontology",
    f"{RDF}first": "a list has no meaning here; name its members one after another, with a `,` between them",
    f"{RDF}subject": "a statement about a statement is no statement",
}


def check_ineffective(
    said: Sequence[Statement], facts: Iterable[Statement], vocabulary: Vocabulary, own: Set[str], used: Set[Node]
) -> Iterator[Diagnostic]:
    """Yield a warning for each kind of statement of a scene that is not a fact and has no effect.

    `own` are the classes that the scene declares; `used` are nodes that other checks have read.
    """
    kinds, of_blank = _Kinds(said, vocabulary, own), _of_blank(said)
    counted = {(each.lines.path, each.subject_at, each.predicate_at, each.object_at) for each in facts}
    ignored = _with_nested((each.object for each in said if kinds.is_note(each)), of_blank) | used
    found: dict[str, list[Statement]] = defaultdict(list)
    for each in said:
        place = each.lines.path, each.subject_at, each.predicate_at, each.object_at
        named = isinstance(each.subject, ox.NamedNode) and each.subject not in ignored
        if named and place not in counted and not kinds.is_understood(each):
            found[_kind(each)].append(each)
    nested = _with_nested((each.object for each in said if isinstance(each.subject, ox.NamedNode)), of_blank)
    for node in () if kinds.is_ontology else of_blank:
        if (
            node not in ignored
            and node not in nested
            and not any(_is_of_world(each, vocabulary) for each in of_blank[node])
        ):
            first = _first(of_blank[node])
            found[_kind(first)].append(first)
            nested |= _with_nested([node], of_blank)
    for term, statements in found.items():
        yield _problem(term, statements, vocabulary)


class _Kinds:
    """Decides which statements of a scene are understood although they are not facts about individuals."""

    def __init__(self, said: Sequence[Statement], vocabulary: Vocabulary, own: Set[str]) -> None:
        self._vocabulary, self._own, self._terms = vocabulary, own, terms_of(vocabulary) - own
        types = {(each.subject, iri_of(each.object)) for each in said if _is_type(each)}
        self._notes = {iri_of(subject) for subject, cls in types if cls == ANNOTATION}
        self._templates = {subject for subject, cls in types if cls == TEMPLATE}
        self.is_ontology = any(cls == f"{OWL}Ontology" for _, cls in types)

    def is_note(self, each: Statement) -> bool:
        """Whether a statement is for people and other tools."""
        return is_annotation(each.predicate) or each.predicate in self._notes

    def is_understood(self, each: Statement) -> bool:
        """Whether the statement has a meaning although it is not a fact."""
        subject, object_ = iri_of(each.subject), iri_of(each.object)
        if self.is_note(each) or each.subject in self._templates or each.predicate in ELSEWHERE:
            return True
        if is_misspelt(each.predicate) or (_is_type(each) and is_misspelt(object_)):
            return True
        if self.is_ontology and subject in self._terms:
            return True
        if _is_type(each):
            return self._is_declared(subject, object_)
        if each.predicate == SUBCLASS and object_:
            return subject in self._own or object_ in self._vocabulary.ancestors.get(subject, ())
        return False

    def _is_declared(self, iri: str, kind: str) -> bool:
        """Whether another check handles a type, or the vocabulary has a term of a kind that scenes may declare."""
        if kind in CLASS_DECLARATIONS:
            return iri in self._vocabulary.classes
        match kind.removeprefix(OWL):
            case "ObjectProperty":
                return iri in self._vocabulary.relations
            case "DatatypeProperty":
                return iri in self._vocabulary.properties
            case _:
                return kind in TYPES_ELSEWHERE


def check_language_tags(facts: Iterable[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a warning for each text of a property with a language tag."""
    for each in facts:
        if each.predicate in vocabulary.properties and isinstance(each.object, ox.Literal) and each.object.language:
            message = f"the language `@{each.object.language}` has no effect: texts are used in any language"
            yield Diagnostic(
                NAME, each.object_place, message, f"write {ox.Literal(each.object.value)}", severity="warning"
            )


def is_ordinary(predicate: str) -> bool:
    """Whether statements with a predicate are facts or annotations."""
    return predicate in (RDF_TYPE, SUBCLASS) or is_annotation(predicate) or not is_remark(predicate)


def is_ordinary_class(cls: str) -> bool:
    """Whether statements that something is of a class are understood."""
    return cls in DECLARATIONS or not is_term_kind(cls)


def check_missing_classes(said: Sequence[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield an error for each individual without a class, and for each of the class owl:Nothing."""
    typed = {each.subject for each in said if _is_type(each) and iri_of(each.object) != NAMED_INDIVIDUAL}
    reported: set[Node] = set()
    for each in said:
        if not _is_type(each) or not isinstance(each.subject, ox.NamedNode):
            continue
        name = vocabulary.short(each.subject.value)
        if iri_of(each.object) == NOTHING:
            message = f"{name} is of the class owl:Nothing, which has no individuals"
            yield Diagnostic("disjoint-classes", each.object_place, message, "say what it is")
        elif iri_of(each.object) == NAMED_INDIVIDUAL and each.subject not in typed | reported:
            reported.add(each.subject)
            others = [one for one in said if one.subject == each.subject and not is_remark(one.predicate)]
            if len(others) == 1:
                help_ = "say what it is: `a CLASS ;`"
                yield Diagnostic("unknown-individual", each.subject_place, f"{name} has no class", help_)


def _kind(each: Statement) -> str:
    """Return the term that names a kind of statement."""
    return iri_of(each.object) if _is_type(each) else each.predicate


def _of_blank(said: Iterable[Statement]) -> dict[Node, list[Statement]]:
    found: dict[Node, list[Statement]] = defaultdict(list)
    for each in said:
        if isinstance(each.subject, ox.BlankNode):
            found[each.subject].append(each)
    return found


def _is_type(each: Statement) -> bool:
    return each.predicate == RDF_TYPE and isinstance(each.object, ox.NamedNode)


def _is_of_world(each: Statement, vocabulary: Vocabulary) -> bool:
    """Whether a statement would be a fact if its subject had a name; that is reported elsewhere."""
    relation = each.predicate in vocabulary.relations or each.predicate in vocabulary.properties
    return relation or (_is_type(each) and iri_of(each.object) in vocabulary.classes)


def _first(statements: Sequence[Statement]) -> Statement:
    """Return the statement that best describes a blank node."""
    return next((each for each in statements if _is_type(each)), statements[0])


def _with_nested(nodes: Iterable[Node], of_blank: dict[Node, list[Statement]]) -> set[Node]:
    """Return the blank nodes among nodes, and all that are reachable from them."""
    return reachable(_blank(nodes), lambda node: _blank(each.object for each in of_blank.get(node, ())))


def _blank(nodes: Iterable[Node]) -> Iterator[Node]:
    return (each for each in nodes if isinstance(each, ox.BlankNode))


def _problem(term: str, statements: Sequence[Statement], vocabulary: Vocabulary) -> Diagnostic:
    places = [_place(each, term) for each in statements]
    times = f", {len(places)} times" if len(places) > 1 else ""
    more = [Label(place, "and here") for place in places[1:SHOWN]]
    help_ = _HELP.get(term, "the rest of the scene is used")
    message = f"`{vocabulary.short(term)}` has no effect in a scene{times}"
    return Diagnostic(NAME, places[0], message, help_, labels=tuple(more), severity="warning")


def _place(each: Statement, term: str) -> Span:
    return each.object_place if iri_of(each.object) == term else each.predicate_place
