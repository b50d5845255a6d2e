"""Finds the levels that numbers which skills change can reach, for planners (see `skillc_model.levels`)."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import product
from typing import NamedTuple

from msgspec import structs

from skillc_model.conditions import Condition, Expression, PropertyOf, Variable
from skillc_model.levelling import LevelledLibrary, level_library
from skillc_model.levels import AMOUNT, LEVEL, NOW, LevelChange, number_of
from skillc_model.rewriting import map_children
from skillc_model.rounding import is_above, is_same
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import free_variables, walk
from skillc_rdf.vocabulary.types import Bounds
from skillc_runtime.cancellation import check_current
from skillc_runtime.planning.plan import LeftOut
from skillc_runtime.planning.stated_facts import LibraryKey, VocabularyKey
from skillc_runtime.world.eval.expressions import Bindings, value_of
from skillc_runtime.world.state.axioms import WorldAxioms
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.versioned import PairIndex, VersionedMap
from skillc_runtime.world.state.world_state import WorldState

MOST_LEVELS = 300
"""How many values of a property are planned with at most, if it can have no others."""

FEW_LEVELS = 40
"""How many are planned with of a property that may have more than MOST_LEVELS; more steps lead to the others."""

MOST_COMBINATIONS = 100_000
"""For how many combinations of things and levels the change of a number is computed at most."""

MORE_VALUES = LeftOut(
    ("other values",),
    "skills may give a number very many values: those that few of them lead to are planned with",
    harmless=False,
    kind="numbers",
)


class LevelledProblem(NamedTuple):
    """A library, a world and a goal that read levels in place of numbers, and what is left out of them."""

    library: SkillLibrary
    state: WorldState
    goal: Condition
    left_out: tuple[LeftOut, ...] = ()


def level_problem(library: SkillLibrary, state: WorldState, goal: Condition) -> LevelledProblem:
    """Return what a planner is to plan with instead of numbers that skills change; the same without such."""
    levelled = _level_library(LibraryKey(library), VocabularyKey(library.vocabulary), goal)
    if not levelled.levelling.numbers and not levelled.levelling.idle:
        return LevelledProblem(library, state, goal)
    levels = _Levels(levelled, state)
    levels.reach_all()
    left_out = (MORE_VALUES,) if levels.is_cut else ()
    return LevelledProblem(levelled.library, levels.state_facts(), levelled.levelling.of(goal, {}), left_out)


@lru_cache(maxsize=16)
def _level_library(key: LibraryKey, vocabulary: VocabularyKey, goal: Condition) -> LevelledLibrary:
    return level_library(structs.replace(key.library, vocabulary=vocabulary.vocabulary), goal)


class _Levels:
    """The numbers that each property can get, in the order in which they are found."""

    def __init__(self, levelled: LevelledLibrary, state: WorldState) -> None:
        self._levelled, self._state = levelled, state
        self.is_cut = False
        self._endless: set[str] = set()
        numbers = sorted(levelled.levelling.numbers)
        self._values: dict[str, list[float]] = {iri: [] for iri in numbers}
        self._sorted: dict[str, list[float]] = {iri: [] for iri in numbers}
        self._now = {iri: dict(self._read(iri)) for iri in numbers}
        self._steps: dict[str, dict[float, float]] = {each.relation or "": {} for each in levelled.changes}

    def _read(self, iri: str) -> Iterator[tuple[str, float]]:
        """Yield the things that have a value, with its level."""
        for individual in self._list_owners(iri):
            value = property_of(self._state, individual, iri)
            level = self._add(iri, value) if isinstance(value, int | float) else None
            if level is not None:
                yield individual, level

    def _list_owners(self, iri: str) -> list[str]:
        domains = self._state.vocabulary.properties[iri].domains
        return sorted(frozenset().union(*map(self._state.instances, domains)))

    def reach_all(self) -> None:
        """Find the levels that steps lead to, those first that few steps lead to."""
        changes = [
            _NamedChange(each, self._levelled.levelling.levels_in(each.value)) for each in self._levelled.changes
        ]
        for each in changes:
            if not each.reads:
                self._apply(each, ((),))
        done = dict.fromkeys(self._values, 0)
        while done != (known := {iri: len(values) for iri, values in self._values.items()}):
            for each in (each for each in changes if each.reads):
                spans = [(done[read.property], known[read.property]) for read in each.reads]
                self._apply(each, _list_new(spans))
            done = known
        for iri in self._endless:
            self.is_cut = True
            del self._values[iri][max(FEW_LEVELS, len(set(self._now[iri].values()))) :]

    def _apply(self, change: _NamedChange, places: Iterable[tuple[int, ...]]) -> None:
        """Add what a change leads to from levels, by their places."""
        members = [sorted(self._state.instances(change.of.classes[name])) for name in change.things]
        count = 0
        for at in places:
            check_current()
            values = [self._values[read.property][place] for place, read in zip(at, change.reads, strict=True)]
            before = {_level_name(place): value for place, value in enumerate(values)}
            for things in product(*members):
                count += 1
                if count > MOST_COMBINATIONS:
                    self.is_cut = True
                    return
                self._reach(change, {**before, **dict(zip(change.things, things, strict=True))})

    def _reach(self, change: _NamedChange, bindings: Bindings) -> None:
        try:
            number = value_of(change.value, self._state, bindings)
        except EvaluationError:
            return
        reached = self._add(change.of.property, number) if isinstance(number, int | float) else None
        before = bindings.get(_level_name(0))
        if reached is not None and change.of.relation is not None and isinstance(before, int | float):
            self._steps[change.of.relation][before] = reached

    def _add(self, iri: str, number: float) -> float | None:
        """Return the level that a number is but for rounding; None if it is out of range, or too many are known."""
        bounds, known = self._state.vocabulary.properties[iri].bounds, self._sorted[iri]
        if bounds is not None and not _is_within(number, bounds):
            return None
        place = bisect_left(known, number)
        for near in known[max(place - 1, 0) : place + 1]:
            if is_same(near, number):
                return near
        if len(known) >= MOST_LEVELS:
            self._endless.add(iri)
            return None
        known.insert(place, number)
        self._values[iri].append(number)
        return number

    def state_facts(self) -> WorldState:
        """Return the world with the levels, at which things are, and between which steps lead."""
        vocabulary = self._levelled.library.vocabulary
        state = self._state
        world = replace(
            state,
            vocabulary=vocabulary,
            axioms=WorldAxioms(vocabulary),
            asserted={**{iri: PairIndex.empty() for iri in vocabulary.relations}, **state.asserted},
            facts={**{iri: PairIndex.empty() for iri in vocabulary.relations}, **state.facts},
            stored={**{iri: VersionedMap(None) for iri in vocabulary.properties}, **state.stored},
        )
        return world.with_changes(self._list_facts())

    def _list_facts(self) -> Iterator[Change]:
        for iri, values in self._values.items():
            for value in values:
                yield AddIndividual(_iri(iri, value), (iri + LEVEL,))
                yield SetProperty(_iri(iri, value), iri + AMOUNT, value)
            for individual, level in self._now[iri].items():
                yield AddRelation(individual, iri + NOW, _iri(iri, level))
            if any(each.property == iri and number_of(each) not in walk(each.value) for each in self._levelled.changes):
                yield AddIndividual(_iri(iri, None), (iri + LEVEL,))
                others = (each for each in self._list_owners(iri) if each not in self._now[iri])
                yield from (AddRelation(each, iri + NOW, _iri(iri, None)) for each in others)
        for change in self._levelled.changes:
            if change.relation is not None:
                iri, kept = change.property, set(self._values[change.property])
                steps = self._steps[change.relation].items()
                for before, after in (each for each in steps if kept.issuperset(each)):
                    yield AddRelation(_iri(iri, before), change.relation, _iri(iri, after))


class _NamedChange:
    """A change whose value is computed from levels and things by name."""

    def __init__(self, change: LevelChange, reads: Iterable[PropertyOf]) -> None:
        self.of = change
        self.reads = tuple(dict.fromkeys(reads))
        levels = {read: Variable(_level_name(place)) for place, read in enumerate(self.reads)}
        self.value = _name_levels(change.value, levels)
        self.things = sorted(free_variables(self.value) - {each.name for each in levels.values()})


def _level_name(place: int) -> str:
    return f"|{place}"


def _list_new(spans: Sequence[tuple[int, int]]) -> Iterator[tuple[int, ...]]:
    """Yield the combinations of places below the second number of each span, one of them not below the first."""
    for number, (done, known) in enumerate(spans):
        before = (range(first) for first, _ in spans[:number])
        after = (range(last) for _, last in spans[number + 1 :])
        yield from product(*before, range(done, known), *after)


def _iri(property_: str, value: float | None) -> str:
    return f"{property_}-{'none' if value is None else f'{value:.12g}'}"


def _is_within(number: float, bounds: Bounds) -> bool:
    low, high = bounds.least, bounds.greatest
    return not (low is not None and is_above(low, number)) and not (high is not None and is_above(number, high))


def _name_levels(value: Expression, levels: Mapping[PropertyOf, Variable]) -> Expression:
    if isinstance(value, PropertyOf) and value in levels:
        return levels[value]
    return map_children(value, lambda part: _name_levels(part, levels))
