"""Finds the unsatisfiable classes and relations of a vocabulary."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import Literal, NamedTuple

from skillc_rdf.vocabulary.closure import Directed
from skillc_rdf.vocabulary.expressions import RequiredValue
from skillc_rdf.vocabulary.types import THING, RelationTerm, Vocabulary

MOST_CHOICES = 4096
"""The most combinations of alternative domains that are tried; beyond it, satisfiability is assumed."""


class Reason(NamedTuple):
    """Why a class or relation is unsatisfiable, as text.

    `follows`: because something else is. `pair`: the disjoint classes. `kind`: what makes a relation unsatisfiable: its
    domain and range, its super-relations, or its characteristics.
    """

    text: str
    follows: bool = False
    pair: tuple[str, str] | None = None
    kind: Literal["domain", "parent", "kind"] = "kind"


class Limit(NamedTuple):
    """The subject of a relation, or its object, is of one of some classes."""

    of_object: bool
    choice: tuple[str, ...]


class Unsatisfiable:
    """The unsatisfiable classes and relations of a vocabulary; `needs` are the required values of each class."""

    def __init__(self, vocabulary: Vocabulary, needs: Mapping[str, Sequence[RequiredValue]]) -> None:
        self._vocabulary = vocabulary
        self._needs = needs
        self.classes: dict[str, Reason] = {}
        self.relations: dict[str, Reason] = {}
        self._find()

    def _find(self) -> None:
        """Iterate to a fixed point: what requires something unsatisfiable is unsatisfiable."""
        for cls in self._vocabulary.classes:
            if pair := self._clash((cls,)):
                follows = any(self._clash((parent,)) for parent in self._vocabulary.classes[cls].parents)
                self.classes[cls] = Reason(self._nothing_in_common(pair), follows, pair)
        found = -1
        while found != len(self.classes) + len(self.relations):
            found = len(self.classes) + len(self.relations)
            self._relations()
            self._needy()

    def _relations(self) -> None:
        closure = self._vocabulary.closure
        limits = closure.inherited(self._limits())
        possible = {each: self._are_possible(each) for each in set(limits.values())}
        for group in closure.equivalents:
            if group[0] not in self.relations and (
                reason := self._relation(group, possible[limits[Directed(group[0])]])
            ):
                self.relations[group[0]] = reason
                self.relations |= dict.fromkeys(group[1:], reason._replace(follows=True))

    def _needy(self) -> None:
        """Find classes that require something unsatisfiable, and subclasses of unsatisfiable ones."""
        for cls in sorted(self._vocabulary.classes.keys() - self.classes.keys()):
            above = self._vocabulary.ancestors[cls]
            if not self.classes.keys().isdisjoint(above):
                self.classes[cls] = Reason("it has a superclass without possible members", follows=True)
            elif reason := next(self._unmet(cls, above), None):
                inherited = any(
                    next(self._unmet(up, self._vocabulary.ancestors[up]), None) for up in above - {cls, THING}
                )
                self.classes[cls] = reason._replace(follows=reason.follows or inherited)

    def _unmet(self, cls: str, above: frozenset[str]) -> Iterator[Reason]:
        """Yield why the members of a class cannot have the required values."""
        needed = [need for other in sorted(above & self._needs.keys()) for need in self._needs[other]]
        short = self._vocabulary.short
        for need in needed:
            if need.property in self.relations:
                yield Reason(f"it needs `{short(need.property)}`, which can never hold", follows=True)
            elif need.filler in self.classes:
                yield Reason(f"it needs a `{short(need.filler or '')}`, and nothing can be one", follows=True)
            elif need.property in self._vocabulary.relations:
                yield from self._misfit(cls, need)
            elif need.property in self._vocabulary.properties:
                yield from self._wrong_owner(cls, need)
        yield from self._too_many(cls, needed)

    def _misfit(self, cls: str, need: RequiredValue) -> Iterator[Reason]:
        """Yield why a class or a required value does not fit the domain or range of the relation."""
        relation, starts, ends = self._vocabulary.short(need.property), *self._ends(need.property)
        if not self._possible([(cls,), *starts]):
            yield Reason(f"it needs `{relation}`, which is of other things")
        filler = (need.filler,) if need.filler else ()
        if filler and not self._possible([filler, *ends]):
            yield Reason(
                f"it needs `{relation}` with a `{self._vocabulary.short(filler[0])}`, and leads to other things"
            )

    def _wrong_owner(self, cls: str, need: RequiredValue) -> Iterator[Reason]:
        term = self._vocabulary.properties[need.property]
        if not self._possible([(cls,), term.domains]):
            yield Reason(f"it needs `{self._vocabulary.short(need.property)}`, which is of other things")
        if term.functional and need.least > 1:
            yield Reason(f"it needs {need.least} values of `{self._vocabulary.short(need.property)}`, which has one")

    def _too_many(self, cls: str, needed: Sequence[RequiredValue]) -> Iterator[Reason]:
        """Yield why a class requires several values of a functional relation."""
        fillers: dict[str, list[tuple[str, ...]]] = {}
        for need in needed:
            for single in self._single(need.property):
                name = self._vocabulary.short(single)
                if need.least > 1:
                    yield Reason(f"it needs {need.least} of `{name}`, which leads to one thing only")
                ends = self._ends(need.property)[1]
                fillers.setdefault(single, []).extend([*ends, *([(need.filler,)] if need.filler else [])])
        for single, choices in fillers.items():
            if not self._possible(choices):
                yield Reason(
                    f"it needs different things by `{self._vocabulary.short(single)}`, which leads to one only"
                )

    def _single(self, relation: str) -> list[str]:
        """Return the relations, functional in this direction, that one implies."""
        return [
            iri
            for iri, flipped in self._implied.get(relation, ())
            if (not flipped and self._vocabulary.relations[iri].functional)
            or (flipped and self._vocabulary.relations[iri].inverse_functional)
        ]

    def _relation(self, group: Sequence[str], ends_possible: bool) -> Reason | None:
        """Return why equivalent relations can never hold, None if they can; those above them are known."""
        if not self.relations.keys().isdisjoint(self._vocabulary.closure.directly_above(group)):
            return Reason("it implies a relation that can never hold", follows=True)
        if group[0] in self._twisted and (clash := self._both_ways(frozenset(self._implied[group[0]]))):
            return clash
        return None if ends_possible else self._misplaced(group[0])

    def _misplaced(self, iri: str) -> Reason | None:
        """Return why nothing can be the subject, or nothing the object, of a relation."""
        for sides in self._ends(iri):
            if not self._possible(sides):
                own = len(self._implied[iri]) == 1
                limits = {each for each in sides if THING not in each}
                names = ", ".join(sorted({" or ".join(map(self._vocabulary.short, each)) for each in limits}))
                pair = self._clash([each[0] for each in limits if len(each) == 1])
                return Reason(f"nothing is all of {names}", pair=pair, kind="domain" if own else "parent")
        return None

    def _both_ways(self, reached: frozenset[Directed]) -> Reason | None:
        short = self._vocabulary.short
        known = self._vocabulary.relations
        for other, flipped in sorted(reached):
            term: RelationTerm = known[other]
            if (other, not flipped) not in reached:
                continue
            if term.asymmetric:
                return Reason(f"by it `{short(other)}` would hold both ways, and it is asymmetric")
            looping = [up for up, _ in self._implied[other] if known[up].irreflexive] if term.transitive else []
            if looping:
                text = f"by it something would be `{short(looping[0])}` to itself, and that is irreflexive"
                return Reason(text)
        return None

    def _ends(self, relation: str) -> tuple[list[tuple[str, ...]], list[tuple[str, ...]]]:
        """Return the constraints on the subjects and on the objects of a relation: one class of each tuple."""
        sides: tuple[list[tuple[str, ...]], list[tuple[str, ...]]] = ([], [])
        for iri, flipped in self._implied[relation]:
            domains, ranges = _own_ends(self._vocabulary.relations[iri])
            sides[flipped].append(domains)
            sides[not flipped].append(ranges)
        return sides

    def _limits(self) -> dict[Directed, frozenset[Limit]]:
        """Return the limits of each relation, in both directions, that can contradict another or themselves."""
        own = {iri: _own_ends(term) for iri, term in self._vocabulary.relations.items()}
        every = {cls for ends in own.values() for choice in ends for cls in choice} - {THING}
        used = frozenset[str]().union(*(self._above.get(cls, frozenset({cls})) for cls in every))
        pairs = ({cls, *others} for cls in self._apart.keys() & used if (others := self._apart[cls] & used))
        contested = set[str]().union(*pairs)
        harmful = {cls for cls in every if cls in self.classes or not contested.isdisjoint(self._above.get(cls, ()))}
        return {
            Directed(iri, flipped): frozenset(
                Limit(side != flipped, choice) for side, choice in enumerate(ends) if harmful.issuperset(choice)
            )
            for iri, ends in own.items()
            for flipped in (False, True)
        }

    def _are_possible(self, limits: frozenset[Limit]) -> bool:
        return all(self._possible([each.choice for each in limits if each.of_object == side]) for side in (False, True))

    def _possible(self, choices: Sequence[tuple[str, ...]]) -> bool:
        """Whether an individual can be of one of the classes of each tuple."""
        distinct = sorted({each for each in choices if THING not in each})
        for number, chosen in enumerate(product(*distinct)):
            if number >= MOST_CHOICES or not (self._clash(chosen) or any(cls in self.classes for cls in chosen)):
                return True
        return False

    def _clash(self, classes: Sequence[str]) -> tuple[str, str] | None:
        """Return two disjoint classes above the given ones, None if there are none."""
        if not self._apart:
            return None
        above = frozenset[str]().union(*(self._above.get(cls, frozenset({cls})) for cls in classes))
        one = min((cls for cls in above & self._apart.keys() if not self._apart[cls].isdisjoint(above)), default=None)
        return None if one is None else (one, min(self._apart[one] & above))

    def _nothing_in_common(self, pair: tuple[str, str]) -> str:
        one, other = map(self._vocabulary.short, pair)
        return f"it is below `{other}` and `{one}`, which are disjoint"

    @cached_property
    def _above(self) -> dict[str, frozenset[str]]:
        """Each class with all classes above it, including the domains of the relations that it requires."""
        above = dict(self._vocabulary.ancestors)
        while True:
            wider = {cls: self._with_domains(classes, above) for cls, classes in above.items()}
            if wider == above:
                return above
            above = wider

    def _with_domains(self, classes: frozenset[str], above: Mapping[str, frozenset[str]]) -> frozenset[str]:
        needed = {need.property for cls in classes & self._needs.keys() for need in self._needs[cls]}
        starts = (self._ends(iri)[0] for iri in needed if iri in self._vocabulary.relations)
        single = {choice[0] for sides in starts for choice in sides if len(choice) == 1}
        return classes.union(single, *(above.get(cls, ()) for cls in single)) if single else classes

    @cached_property
    def _apart(self) -> dict[str, frozenset[str]]:
        """The classes that are declared disjoint with others, with these."""
        return {iri: frozenset(term.disjoint) for iri, term in self._vocabulary.classes.items() if term.disjoint}

    @cached_property
    def _twisted(self) -> frozenset[str]:
        """The relations that may imply, in both directions, one that cannot hold so."""
        known, closure = self._vocabulary.relations, self._vocabulary.closure
        strict = closure.below(iri for iri, term in known.items() if term.irreflexive)
        one_way = (iri for iri, term in known.items() if term.asymmetric or (term.transitive and iri in strict))
        return closure.twisted(closure.below(one_way))

    @property
    def _implied(self) -> Mapping[str, tuple[Directed, ...]]:
        return self._vocabulary.closure.implied


def _own_ends(relation: RelationTerm) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the alternative domains and the alternative ranges that are stated of a relation."""
    domains = tuple(dict.fromkeys(each.domain for each in relation.signatures))
    return domains or (THING,), tuple(dict.fromkeys(each.range for each in relation.signatures)) or (THING,)
