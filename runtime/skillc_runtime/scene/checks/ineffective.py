"""What a scene says that has no effect: each kind of statement is named, nothing is left out in silence."""

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
"""How many of the places of one kind of statement are noted."""
NOTHING = f"{OWL}Nothing"
DECLARATIONS = frozenset({*CLASS_DECLARATIONS, ANNOTATION, TEMPLATE, f"{OWL}Ontology"})
"""Whatever is of these classes is understood, and no individual."""
TYPES_ELSEWHERE = DECLARATIONS | {NOTHING, NAMED_INDIVIDUAL, THING}
ELSEWHERE = frozenset({HAS_TEMPLATE, TEMPLATE, f"{OWL}sameAs", f"{OWL}differentFrom"})
"""What other rules tell of."""
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
    """Yield a warning for each kind of statement of a scene that is no fact and changes nothing.

    `own` are the classes that the scene declares; `used` are things that other rules have read.
    """
    kinds, of_blank = _Kinds(said, vocabulary, own), _of_blank(said)
    counted = {(each.lines.path, each.subject_at, each.predicate_at, each.object_at) for each in facts}
    passed = _with_nested((each.object for each in said if kinds.is_note(each)), of_blank) | used
    found: dict[str, list[Statement]] = defaultdict(list)
    for each in said:
        place = each.lines.path, each.subject_at, each.predicate_at, each.object_at
        named = isinstance(each.subject, ox.NamedNode) and each.subject not in passed
        if named and place not in counted and not kinds.is_understood(each):
            found[_kind(each)].append(each)
    told = _with_nested((each.object for each in said if isinstance(each.subject, ox.NamedNode)), of_blank)
    for node in () if kinds.is_ontology else of_blank:
        if (
            node not in passed
            and node not in told
            and not any(_is_of_world(each, vocabulary) for each in of_blank[node])
        ):
            first = _first(of_blank[node])
            found[_kind(first)].append(first)
            told |= _with_nested([node], of_blank)
    for term, statements in found.items():
        yield _problem(term, statements, vocabulary)


class _Kinds:
    """Which statements of a scene are understood though they are no facts about individuals."""

    def __init__(self, said: Sequence[Statement], vocabulary: Vocabulary, own: Set[str]) -> None:
        self._vocabulary, self._own, self._terms = vocabulary, own, terms_of(vocabulary) - own
        types = {(each.subject, iri_of(each.object)) for each in said if _is_type(each)}
        self._notes = {iri_of(subject) for subject, cls in types if cls == ANNOTATION}
        self._templates = {subject for subject, cls in types if cls == TEMPLATE}
        self.is_ontology = any(cls == f"{OWL}Ontology" for _, cls in types)

    def is_note(self, each: Statement) -> bool:
        """Whether something is said for people and other tools."""
        return is_annotation(each.predicate) or each.predicate in self._notes

    def is_understood(self, each: Statement) -> bool:
        """Whether nothing is lost when the statement is no fact."""
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
        """Whether a type is told elsewhere, or the vocabulary has a term of this kind, which the scene may declare."""
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
    """Yield a warning for each text of a property that says in which language it is."""
    for each in facts:
        if each.predicate in vocabulary.properties and isinstance(each.object, ox.Literal) and each.object.language:
            message = f"the language `@{each.object.language}` has no effect: the text counts, in whatever language"
            yield Diagnostic(
                NAME, each.object_place, message, f"write {ox.Literal(each.object.value)}", severity="warning"
            )


def is_ordinary(predicate: str) -> bool:
    """Whether what is said with a predicate is a fact, or for people and other tools."""
    return predicate in (RDF_TYPE, SUBCLASS) or is_annotation(predicate) or not is_remark(predicate)


def is_ordinary_class(cls: str) -> bool:
    """Whether it is understood, or told elsewhere, that something is of a class."""
    return cls in DECLARATIONS or not is_term_kind(cls)


def check_missing_classes(said: Sequence[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield an error for each named individual of which no class is said, and for each of the class that is empty."""
    typed = {each.subject for each in said if _is_type(each) and iri_of(each.object) != NAMED_INDIVIDUAL}
    told: set[Node] = set()
    for each in said:
        if not _is_type(each) or not isinstance(each.subject, ox.NamedNode):
            continue
        name = vocabulary.short(each.subject.value)
        if iri_of(each.object) == NOTHING:
            message = f"{name} is of the class owl:Nothing, and nothing is"
            yield Diagnostic("disjoint-classes", each.object_place, message, "say what it is")
        elif iri_of(each.object) == NAMED_INDIVIDUAL and each.subject not in typed | told:
            told.add(each.subject)
            others = [one for one in said if one.subject == each.subject and not is_remark(one.predicate)]
            if len(others) == 1:
                help_ = "say what it is: `a CLASS ;`"
                yield Diagnostic("unknown-individual", each.subject_place, f"{name} is of no class", help_)


def _kind(each: Statement) -> str:
    """Return the term by which a statement is named."""
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
    """Whether a statement would be a fact if its subject had a name, which is told."""
    relation = each.predicate in vocabulary.relations or each.predicate in vocabulary.properties
    return relation or (_is_type(each) and iri_of(each.object) in vocabulary.classes)


def _first(statements: Sequence[Statement]) -> Statement:
    """Return the statement that says best what a thing without a name is."""
    return next((each for each in statements if _is_type(each)), statements[0])


def _with_nested(nodes: Iterable[Node], of_blank: dict[Node, list[Statement]]) -> set[Node]:
    """Return the things without a name among nodes, and all below them."""
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
