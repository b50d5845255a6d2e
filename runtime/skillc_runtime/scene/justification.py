"""Finds from which facts and which rules of ontologies a fact follows that a scene does not state."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, TypeVar

import pyoxigraph as ox

from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.classification import DERIVED, RuleFact, SceneRules

MOST_FACTS = 2_000
"""A reason is looked for among at most so many facts, those nearest to the derived one."""

PartT = TypeVar("PartT")


class Justification(NamedTuple):
    """A derived fact, and the facts and rules (heads of axioms) without any of which it would not follow from them.

    There may be others from which it follows as well.
    """

    fact: RuleFact
    facts: tuple[RuleFact, ...]
    rules: tuple[ox.Triple, ...]


def justify(said: Sequence[Statement], vocabulary: Vocabulary, individual: str) -> Iterator[Justification]:
    """Yield why what rules say of an individual follows from the statements of a scene, as `read_scene` returns them.

    What follows only with facts that are far away is left out. A minimal set is found by dividing the facts and rules
    (Junker, "QuickXplain", 2004), each time with all that follows from a part.
    """
    derived = [each for each in said if each.lines.path == DERIVED]
    wanted = [each for each in derived if isinstance(each.subject, ox.NamedNode) and each.subject.value == individual]
    if not wanted:
        return
    rules = SceneRules(vocabulary)
    stated = (each for each in said if each.lines.path != DERIVED and each.predicate not in vocabulary.changing)
    given = frozenset(rules.translate(stated))
    for each in wanted:
        assert isinstance(each.subject, ox.NamedNode) and isinstance(each.object, ox.NamedNode | ox.Literal)
        fact = each.subject, ox.NamedNode(each.predicate), each.object
        found = _justify(fact, given, rules)
        if found is not None:
            yield found


def _justify(fact: RuleFact, given: frozenset[RuleFact], rules: SceneRules) -> Justification | None:
    near = next((facts for facts in _neighbourhoods(fact, given) if fact in rules.close(facts)), None)
    if near is None:
        return None
    units = [*range(len(rules.units))]
    facts = _find_minimal(sorted(near, key=str), lambda part: fact in rules.close(part))
    needed = _find_minimal(units, lambda part: fact in rules.close(facts, part))
    return Justification(fact, tuple(facts), tuple(rules.units[each][0] for each in needed))


def _neighbourhoods(fact: RuleFact, given: frozenset[RuleFact]) -> Iterator[frozenset[RuleFact]]:
    """Yield the facts about the individuals of a fact, then also those about the individuals in these, and so on."""
    known, found = {*_individuals(fact)}, frozenset[RuleFact]()
    while True:
        more = frozenset(each for each in given if not known.isdisjoint(_individuals(each)))
        if more == found or len(more) > MOST_FACTS:
            return
        found = more
        yield found
        known.update(one for each in found for one in _individuals(each))


def _individuals(fact: RuleFact) -> Iterator[ox.NamedNode]:
    subject, said, object_ = fact
    yield subject
    if said.value != RDF_TYPE and isinstance(object_, ox.NamedNode):
        yield object_


def _find_minimal(parts: Sequence[PartT], follows: Callable[[Iterable[PartT]], bool]) -> list[PartT]:
    """Return parts without any of which it would not follow any more from the others; it follows from all."""

    def divide(base: list[PartT], has_changed: bool, rest: list[PartT]) -> list[PartT]:
        if has_changed and follows(base):
            return []
        if len(rest) == 1:
            return rest
        one, other = rest[: len(rest) // 2], rest[len(rest) // 2 :]
        of_other = divide([*base, *one], bool(one), other)
        return [*divide([*base, *of_other], bool(of_other), one), *of_other]

    return divide([], True, [*parts]) if parts else []
