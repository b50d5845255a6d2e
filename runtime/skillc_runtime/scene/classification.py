"""Derives from the rules of ontologies to which classes individuals of a scene belong, and how they are related.

owlrl (extra `ontologies`) applies the rules of OWL 2 RL to what a scene says of the terms in the rules. What is derived
from facts that no skill changes holds as long as the world exists, and is part of the scene. What follows only from
others is named in a warning: it would not follow any more once they have changed.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from importlib.util import find_spec
from typing import Any, NamedTuple, TypeAlias

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import Node, Parsed, Statement
from skillc_rdf.turtle.terms import OWL, RDF_TYPE, RDFS
from skillc_rdf.vocabulary.axioms.rules import split_rules
from skillc_rdf.vocabulary.types import THING, Vocabulary
from skillc_runtime.scene.documents import Document, parse

INVERSE_OF = "urn:skillc:inverse:"
"""What the name of the inverse of a relation begins with: it may imply others without being one of them."""
DERIVED = "rules"
"""What stands for the path of a file where what rules derive is said."""
MOST_FACTS = 20_000
"""The most facts that the rules are applied to, which takes half a minute."""
SHOWN = 3
"""The most derived facts that are named in a message."""

RuleFact: TypeAlias = tuple[ox.NamedNode, ox.NamedNode, ox.NamedNode | ox.Literal]


class _TooManyFacts(Exception):
    """There are so many facts about terms of the rules that they are not applied."""

    def __init__(self, count: int) -> None:
        self.count = count


class Classified(NamedTuple):
    """What the rules of ontologies add to a scene, and warnings about the rest."""

    documents: tuple[Parsed, ...]
    problems: tuple[Diagnostic, ...]


def classify(said: Sequence[Statement], vocabulary: Vocabulary, path: str) -> Classified:
    """Apply the rules of a vocabulary to statements with canonical terms; `path` is the file of the scene."""
    types = {each.object.value for each in said if each.predicate == RDF_TYPE and isinstance(each.object, ox.NamedNode)}
    subjects = {each.subject.value for each in said if isinstance(each.subject, ox.NamedNode)}
    if not may_classify(vocabulary, {each.predicate for each in said}, types, subjects):
        return Classified((), ())
    rules = SceneRules(vocabulary)
    place = Span(path, 1, 1, 1, 2)
    if find_spec("owlrl") is None:
        why, help_ = "owlrl is not installed", "pip install 'skillc[ontologies]'"
        return Classified((), (_report_unclassified(why, help_, place),))
    try:
        return _derive(rules, said, vocabulary, place)
    except _TooManyFacts as error:
        why, help_ = (
            f"they concern {error.count} facts, and {MOST_FACTS} at most are read",
            "state the classes in the scene",
        )
        return Classified((), (_report_unclassified(why, help_, place),))


def may_classify(
    vocabulary: Vocabulary, predicates: Collection[str], classes: Collection[str], subjects: Collection[str]
) -> bool:
    """Whether the rules of a vocabulary, if it has any, read what is said with predicates, of classes and subjects."""
    return bool(vocabulary.rules) and SceneRules(vocabulary).concern(predicates, classes, subjects)


def _report_unclassified(why: str, help_: str, place: Span) -> Diagnostic:
    message = f"the rules of ontologies classify no individuals here: {why}"
    return Diagnostic("unclassified-individuals", place, message, help_, "warning")


def place_derived(problems: Iterable[Diagnostic], path: str) -> Iterator[Diagnostic]:
    """Yield problems; those of what rules have derived stand at the beginning of the scene."""
    for each in problems:
        labels = tuple(label for label in each.labels if label.span.path != DERIVED)
        if each.span.path == DERIVED:
            message = f"{each.message}, as follows from the rules of ontologies"
            each = replace(each, span=Span(path, 1, 1, 1, 2), message=message)
        yield replace(each, labels=labels) if len(labels) < len(each.labels) else each


def _derive(rules: SceneRules, said: Sequence[Statement], vocabulary: Vocabulary, place: Span) -> Classified:
    stable = [each for each in said if each.predicate not in vocabulary.changing]
    lasting = rules.derive(stable)
    passing = rules.derive(said) - lasting if len(stable) < len(said) else frozenset()
    text = "".join(f"{subject} {said_} {object_} .\n" for subject, said_, object_ in sorted(lasting, key=str))
    documents = (parse(Document(DERIVED, text)),) if text else ()
    return Classified(documents, tuple(_report(passing, vocabulary, place)))


def _report(passing: Iterable[RuleFact], vocabulary: Vocabulary, place: Span) -> Iterator[Diagnostic]:
    """Warn of what would follow at first from facts that skills change."""
    shown = [_describe(each, vocabulary) for each in sorted(passing, key=str)]
    if shown:
        more = f" and {len(shown) - SHOWN} more" if shown[SHOWN:] else ""
        message = f"{', '.join(shown[:SHOWN])}{more} would follow from facts that skills change, and is not used"
        help_ = "define a relation by a condition in the library: `relation r(x: A) = ..`"
        yield Diagnostic("passing-class", place, message, help_, "warning")


def _describe(fact: RuleFact, vocabulary: Vocabulary) -> str:
    subject, said, object_ = fact
    ends = [
        vocabulary.short(each.value) if isinstance(each, ox.NamedNode) else each.value for each in (subject, object_)
    ]
    verb = "is a" if said.value == RDF_TYPE else vocabulary.short(said.value)
    return f"`{ends[0]} {verb} {ends[1]}`"


class SceneRules:
    """The rules of a vocabulary with canonical terms, by axiom its `units`, and what it says of the terms in them."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        text = "\n".join(vocabulary.rules)
        written = [
            ox.Triple(self._canonical(each.subject), each.predicate, self._canonical(each.object))  # type: ignore[arg-type]
            for each in ox.parse(text, format=ox.RdfFormat.N_TRIPLES)
        ]
        self._named = {node.value for axiom in written for node in axiom if isinstance(node, ox.NamedNode)}
        self._classes = sorted(self._named & vocabulary.classes.keys())
        self._relations = sorted(self._named & vocabulary.relations.keys())
        self._properties = self._named & vocabulary.properties.keys()
        self._about = (*self._about_terms(),)
        self.units = split_rules(written)

    def concern(self, predicates: Iterable[str], classes: Iterable[str], subjects: Iterable[str]) -> bool:
        """Whether anything is said with these predicates, of these classes or subjects that the rules read."""
        ancestors, implied = self._vocabulary.ancestors, self._vocabulary.closure.implied
        return (
            any(each in self._properties for each in predicates)
            or any(one.relation in self._relations for each in predicates for one in implied.get(each, ()))
            or any(not ancestors.get(each, frozenset()).isdisjoint(self._classes) for each in classes)
            or not self._named.isdisjoint(subjects)
        )

    def derive(self, said: Sequence[Statement]) -> frozenset[RuleFact]:
        """Return what follows from the rules and is not said, of what a scene can say; _TooManyFacts."""
        given = frozenset(self.translate(said))
        if len(given) > MOST_FACTS:
            raise _TooManyFacts(len(given))
        individuals = {each.subject for each in said if isinstance(each.subject, ox.NamedNode)}
        found = self.close(given) - given
        return frozenset(each for each in found if each[0] in individuals and self._can_be_said(*each[1:]))

    def close(self, facts: Iterable[RuleFact], units: Iterable[int] | None = None) -> frozenset[RuleFact]:
        """Return facts and all that follows from them by the rules, or by some of their units, by index."""
        chosen = self.units if units is None else [self.units[each] for each in units]
        axioms = dict.fromkeys((*(triple for unit in chosen for triple in unit), *self._about))
        return _close(tuple(f"{each.subject} {each.predicate} {each.object} ." for each in axioms), frozenset(facts))

    def _canonical(self, node: Node) -> Node:
        if isinstance(node, ox.NamedNode) and node.value in self._vocabulary.aliases:
            return ox.NamedNode(self._vocabulary.aliases[node.value])
        return node

    def translate(self, said: Iterable[Statement]) -> Iterator[RuleFact]:
        """Yield what statements say of individuals in the terms of the rules, also by what they imply."""
        for each in said:
            subject, object_ = each.subject, each.object
            if not isinstance(subject, ox.NamedNode):
                continue
            if each.predicate == RDF_TYPE and isinstance(object_, ox.NamedNode):
                yield from self._list_classes(subject, object_.value)
            elif each.predicate in self._properties and isinstance(object_, ox.NamedNode | ox.Literal):
                yield subject, ox.NamedNode(each.predicate), object_
            elif isinstance(object_, ox.NamedNode):
                yield from self._list_relations(subject, each.predicate, object_)

    def _list_classes(self, individual: ox.NamedNode, cls: str) -> Iterator[RuleFact]:
        above = self._vocabulary.ancestors.get(cls, frozenset())
        yield from (_between(individual, ox.NamedNode(each), RDF_TYPE) for each in self._classes if each in above)

    def _list_relations(self, subject: ox.NamedNode, relation: str, object_: ox.NamedNode) -> Iterator[RuleFact]:
        for implied in self._vocabulary.closure.implied.get(relation, ()):
            if implied.relation in self._relations:
                yield _between(*implied.ends(subject, object_), implied.relation)

    def _about_terms(self) -> Iterator[ox.Triple]:
        """Yield how the terms of the rules follow from each other."""
        vocabulary = self._vocabulary
        for cls in self._classes:
            for above in vocabulary.ancestors[cls].intersection(self._classes) - {cls}:
                yield _about(cls, f"{RDFS}subClassOf", above)
        for relation in self._relations:
            if relation in vocabulary.closure.transitive:
                yield _about(relation, RDF_TYPE, f"{OWL}TransitiveProperty")
            for implied in vocabulary.closure.implied[relation]:
                if implied.relation in self._relations and implied != (relation, False):
                    lower = f"{INVERSE_OF}{relation}" if implied.flipped else relation
                    yield _about(lower, f"{RDFS}subPropertyOf", implied.relation)
            yield _about(relation, f"{OWL}inverseOf", f"{INVERSE_OF}{relation}")

    def _can_be_said(self, said: ox.NamedNode, object_: ox.NamedNode | ox.Literal) -> bool:
        """Whether a derived statement is a fact of scenes that no skill changes."""
        predicate = said.value
        if predicate == RDF_TYPE:
            classes = self._vocabulary.classes.keys() - {THING}
            return isinstance(object_, ox.NamedNode) and object_.value in classes
        known = predicate in self._relations if isinstance(object_, ox.NamedNode) else predicate in self._properties
        return known and predicate not in self._vocabulary.changing and not self._vocabulary.is_computed(predicate)


def _about(term: str, said: str, other: str) -> ox.Triple:
    return ox.Triple(ox.NamedNode(term), ox.NamedNode(said), ox.NamedNode(other))


def _between(subject: ox.NamedNode, object_: ox.NamedNode, relation: str) -> RuleFact:
    return subject, ox.NamedNode(relation), object_


@lru_cache(maxsize=16)
def _close(axioms: tuple[str, ...], given: frozenset[RuleFact]) -> frozenset[RuleFact]:
    """Return all that follows from axioms, in N-Triples, and facts, but what is said of things without a name."""
    import owlrl
    from rdflib import BNode, Graph, URIRef

    graph = Graph()
    facts = (f"{subject} {said} {object_} ." for subject, said, object_ in given)
    graph.parse(data="\n".join((*axioms, *facts)), format="nt")
    owlrl.DeductiveClosure(owlrl.OWLRL_Semantics).expand(graph)
    return frozenset(
        (ox.NamedNode(str(subject)), ox.NamedNode(str(predicate)), _read_node(object_))
        for subject, predicate, object_ in graph
        if isinstance(subject, URIRef) and not isinstance(object_, BNode)
    )


def _read_node(node: Any) -> ox.NamedNode | ox.Literal:
    """Return a node of rdflib that is not blank."""
    if not hasattr(node, "datatype"):
        return ox.NamedNode(str(node))
    return ox.Literal(str(node), datatype=ox.NamedNode(str(node.datatype))) if node.datatype else ox.Literal(str(node))
