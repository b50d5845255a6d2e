"""Checks statements about identity and negative assertions against the finished world."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import pairwise

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.turtle.statements import Node, Statement
from skillc_rdf.turtle.terms import OWL, RDF, RDF_TYPE
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.store.literals import LiteralError, read_literal
from skillc_runtime.world.state.values import has_value
from skillc_runtime.world.state.world_state import WorldState

SAME, DIFFERENT = f"{OWL}sameAs", f"{OWL}differentFrom"
ALL_DIFFERENT, DENIAL = f"{OWL}AllDifferent", f"{OWL}NegativePropertyAssertion"
MEMBERS = (f"{OWL}members", f"{OWL}distinctMembers")
SOURCE, PROPERTY = f"{OWL}sourceIndividual", f"{OWL}assertionProperty"
TARGETS = (f"{OWL}targetIndividual", f"{OWL}targetValue")
PARTS = frozenset({RDF_TYPE, *MEMBERS, SOURCE, PROPERTY, *TARGETS})


class IdentityChecker:
    """Checks the statements of a scene about identity, and its negative assertions.

    `used` are the nodes of statements that were understood.
    """

    def __init__(self, said: Sequence[Statement], state: WorldState) -> None:
        self._said, self._state = said, state
        self._about: dict[Node, list[Statement]] = defaultdict(list)
        for each in said:
            self._about[each.subject].append(each)
        self.used: set[Node] = set()

    def check(self) -> Iterator[Diagnostic]:
        """Yield the problems; `used` is complete afterwards."""
        for each in self._said:
            if each.predicate == SAME:
                yield from self._same(each)
            elif each.predicate == DIFFERENT and each.subject == each.object:
                name = self._short(each.object)
                yield Diagnostic(
                    "different-from-itself", each.object_place, f"{name} is declared different from itself"
                )
            elif each.predicate == RDF_TYPE and iri_of(each.object) == ALL_DIFFERENT:
                yield from self._all_different(each.subject)
            elif each.predicate == RDF_TYPE and iri_of(each.object) == DENIAL:
                yield from self._denied(self._about[each.subject])

    def _same(self, each: Statement) -> Iterator[Diagnostic]:
        if each.subject == each.object:
            return
        one, other = self._short(each.subject), self._short(each.object)
        if self._state.exists(iri_of(each.subject)) and self._state.exists(iri_of(each.object)):
            message = f"{one} and {other} are declared the same, but different names denote different individuals here"
            yield Diagnostic("same-individuals", each.object_place, message, f"call it {one} everywhere")
        else:
            message = f"`{self._state.vocabulary.short(SAME)}` has no effect in a scene: there is no individual {other}"
            yield Diagnostic("no-effect", each.predicate_place, message, severity="warning")

    def _all_different(self, node: Node) -> Iterator[Diagnostic]:
        lists = [each for each in self._about[node] if each.predicate in MEMBERS]
        members = [member for each in lists for member in self._members(each.object)]
        if lists:
            self.used.add(node)
        for one, other in pairwise(sorted(members, key=lambda each: (str(each.object), each.object_at))):
            if one.object == other.object:
                message = f"{self._short(one.object)} is declared different from itself"
                notes = (Label(one.object_place, "also stated here"),)
                yield Diagnostic("different-from-itself", other.object_place, message, "keep one of them", labels=notes)

    def _members(self, head: Node) -> Iterator[Statement]:
        """Yield the statements with the elements of a list, in order."""
        seen: set[Node] = set()
        while head not in seen and self._about.get(head):
            seen.add(head)
            self.used.add(head)
            about = {each.predicate: each for each in self._about[head]}
            if f"{RDF}first" in about:
                yield about[f"{RDF}first"]
            rest = about.get(f"{RDF}rest")
            if rest is None:
                return
            head = rest.object

    def _denied(self, parts: Sequence[Statement]) -> Iterator[Diagnostic]:
        by = {each.predicate: each for each in parts}
        target = next((by[each] for each in TARGETS if each in by), None)
        if SOURCE not in by or PROPERTY not in by or target is None or not by.keys() <= PARTS:
            return
        holds = self._holds(iri_of(by[SOURCE].object), iri_of(by[PROPERTY].object), target.object)
        if holds is None:
            return
        self.used.add(parts[0].subject)
        if holds:
            value = target.object
            words = (self._short(by[SOURCE].object), self._short(by[PROPERTY].object), self._short(value))
            message = f"`{' '.join(words)}` holds in this scene, but is denied"
            yield Diagnostic(
                "denied-fact", target.object_place, message, "keep one of them", labels=self._saying(by, value)
            )

    def _saying(self, by: dict[str, Statement], value: Node) -> tuple[Label, ...]:
        source, predicate = by[SOURCE].object, iri_of(by[PROPERTY].object)
        said = (each for each in self._about[source] if each.predicate == predicate and each.object == value)
        return tuple(Label(each.object_place, "stated here") for each in said)

    def _holds(self, subject: str, predicate: str, value: Node) -> bool | None:
        """Whether a fact holds; None if it is not a fact of the vocabulary."""
        state = self._state
        if not state.exists(subject):
            return None
        if predicate in state.vocabulary.relations:
            return state.holds(subject, predicate, iri_of(value)) if state.exists(iri_of(value)) else None
        term = state.vocabulary.properties.get(predicate)
        if term is None or not isinstance(value, ox.Literal) or term.computed_by is not None:
            return None
        try:
            return has_value(state.value(subject, predicate), read_literal(value, term))
        except LiteralError:
            return None

    def _short(self, node: Node) -> str:
        return self._state.vocabulary.short(node.value) if isinstance(node, ox.NamedNode) else str(node)
