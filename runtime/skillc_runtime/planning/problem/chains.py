"""Poses conditions on chains of facts, such as `a within b`, for planners: see `skillc_model.chains`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache
from typing import NamedTuple

import msgspec
from msgspec.structs import replace

from skillc_model.chains import Chains, Unrolling, find_chains, unroll_library
from skillc_model.conditions import And, Condition, Holds, Individual, Not, Or
from skillc_model.format_condition import format_condition
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.plan import Excluded, LeftOut
from skillc_runtime.planning.problem.definitions import LONG_CHAINS, MOST_STEPS, expand_definitions
from skillc_runtime.planning.problem.levels import level_problem
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.pose import GoalError, PosedProblem, pose_problem, with_vocabulary
from skillc_runtime.planning.stated_facts import LibraryKey, StatedTerms, VocabularyKey
from skillc_runtime.world.state.versioned import PairIndex, PairIndexBuilder
from skillc_runtime.world.state.world_state import WorldState


class UnrolledProblem(msgspec.Struct, frozen=True):
    """A library, a world and a goal without changing chains, and the library with them, to validate plans.

    `left_out` is what is said of chains that may be longer than those planned with.
    """

    library: SkillLibrary
    state: WorldState
    goal: Condition
    whole: SkillLibrary
    left_out: tuple[LeftOut, ...] = ()

    def pose(
        self, without: Sequence[Excluded] = (), size: AbstractionSize | None = None, *, keep_unneeded: bool = False
    ) -> PosedProblem:
        """Return the problem for a planner, as `pose_problem` does."""
        posed = pose_problem(self.library, self.state, self.goal, without, size, keep_unneeded=keep_unneeded)
        return replace(posed, left_out=(*posed.left_out, *self.left_out)) if self.left_out else posed


def unroll_chains(library: SkillLibrary, state: WorldState, goal: Condition) -> UnrolledProblem:
    """Return what a planner is to plan with instead of chains of facts that skills change; the same without such.

    GoalError if the goal asks whether a chain leads back to where it begins, unless axioms say that none does.
    """
    whole = with_vocabulary(library, state.vocabulary)
    library, goal, left_out = expand_definitions(whole, state, goal)
    library, state, goal, more = level_problem(library, state, goal)
    left_out = (*left_out, *more)
    chains = _find_chains(LibraryKey(library), goal)
    if not chains:
        return UnrolledProblem(library, state, goal, whole, left_out)
    links = {each.relation: _Links(each, state) for each in chains}
    lengths = tuple((each, links[each.relation].length) for each in chains)
    unrolled = _unroll_library(LibraryKey(library), VocabularyKey(library.vocabulary), lengths)
    stated = _stated_terms(VocabularyKey(unrolled.vocabulary))
    facts = {each.fixed: links[each.relation].fixed for each in chains}
    facts |= {each.moving: links[each.relation].moving for each in chains}
    wanted = _GoalUnrolling(links, _unrolling(lengths, library.vocabulary)).of(goal)
    if any(each.cut for _, each in lengths):
        left_out = (LONG_CHAINS, *more)
    return UnrolledProblem(unrolled, stated.apply(state, facts), wanted, whole, left_out)


class _Length(NamedTuple):
    """How long chains may become: how many of the things that skills move can carry others, and the classes of all.

    `climbed` as in `Unrolling`.
    """

    carriers: int
    classes: frozenset[str]
    climbed: bool

    @property
    def cut(self) -> bool:
        """Whether there may be longer chains than are planned with."""
        return self.carriers + 1 > MOST_STEPS

    def steps_to(self, cls: str) -> int:
        """Return how many changing steps a chain may have that ends (or starts) with something of a class."""
        return min(self.carriers + (cls in self.classes), MOST_STEPS)


class _Links:
    """The facts of a version of the world that chains of a relation consist of."""

    def __init__(self, chains: Chains, state: WorldState) -> None:
        self.chains, self.state = chains, state
        classes = [state.instances(each) | ({each} & state.individuals) for each in chains.moved]
        self.moved = frozenset().union(*classes)
        """What skills move: what changing steps may lead to, or from."""

    @property
    def is_acyclic(self) -> bool:
        """Whether no chain leads from a thing to itself, as axioms say."""
        term = self.state.vocabulary.relations[self.chains.relation]
        return term.irreflexive or term.asymmetric or term.is_acyclic

    @cached_property
    def length(self) -> _Length:
        relations = self.state.vocabulary.relations
        bearing = {
            (each.domain, each.range)[step.flipped != self.chains.at_start]
            for step in self.chains.steps
            for each in relations[step.relation].signatures
        }
        bearers = frozenset().union(*map(self.state.instances, bearing))
        carriers = frozenset().union(*map(self.movers, bearers))
        ancestors = self.state.classes
        classes = frozenset().union(*(ancestors.get(each) for each, _ in self.moving.pairs()))
        return _Length(len(carriers), classes, self._is_climbed())

    def _is_climbed(self) -> bool:
        """Whether each thing that skills move has one step, and nothing is fixed to two such things."""
        if not self.chains.climbed:
            return False
        (step,) = self.chains.steps
        links = self.state.facts[step.relation]
        homes = links.forward if self.chains.at_start != step.flipped else links.backward
        single = all(len(self.movers(each)) < 2 for each in self.state.individuals)
        return single and all(len(homes.get(each)) == 1 for each in self.moved)

    def movers(self, individual: str) -> frozenset[str]:
        """Return what skills move of the things to which one is fixed, in the direction in which they have a step."""
        fixed = self.fixed.forward if self.chains.at_start else self.fixed.backward
        return fixed.get(individual) & self.moved

    @cached_property
    def moving(self) -> PairIndex:
        """The things that skills move, and those that are fixed to one, each with itself."""
        found = PairIndexBuilder(PairIndex.empty())
        for each in sorted(self.state.individuals):
            if self.movers(each):
                found.add(each, each)
        return found.build()

    @cached_property
    def fixed(self) -> PairIndex:
        """The chains, of any length, that never change; from each thing to itself, too."""
        found = PairIndexBuilder(PairIndex.empty())
        for each in sorted(self.state.individuals):
            for end in {each, *reachable(self._onwards(each), self._onwards)}:
                found.add(each, end)
        return found.build()

    def step(self, start: str, end: str) -> Condition | None:
        """Return that one fact that skills change leads from one individual to another; None if none can."""
        found = []
        for each in self.chains.steps:
            subject, object_ = each.ends(start, end)
            signatures = self.state.vocabulary.relations[each.relation].signatures
            if any(self.state.is_a(subject, one.domain) and self.state.is_a(object_, one.range) for one in signatures):
                found.append(Holds(Individual(subject), each.relation, Individual(object_)))
        return Or(tuple(found)) if found else None

    def _onwards(self, start: str) -> Iterator[str]:
        """Yield what a fact that no skill changes leads to."""
        closure, changing = self.state.vocabulary.closure, {each.relation for each in self.chains.steps}
        for source, flipped in self.state.axioms.sources[self.chains.relation]:
            links = self.state.asserted[source]
            changes = closure.canonical(source).relation in changing
            for end in (links.backward if flipped else links.forward).get(start):
                if not changes or (start if self.chains.at_start else end) not in self.moved:
                    yield end


class _GoalUnrolling(NamedTuple):
    """Unrolls a goal: chains between individuals with those that they may lead over, all others as in skills."""

    links: dict[str, _Links]
    general: Unrolling

    def of(self, goal: Condition, *, negated: bool = False) -> Condition:
        """Return the goal without changing chains; `negated` if it stands in an odd number of negations."""
        match goal:
            case Holds(Individual(subject), relation, Individual(object_)):
                canonical = self.general.vocabulary.closure.canonical(relation)
                links = self.links.get(canonical.relation)
                return goal if links is None else self._between(goal, links, *canonical.ends(subject, object_), negated)
            case Not(body):
                return Not(self.of(body, negated=not negated))
            case And(parts) | Or(parts):
                return type(goal)(tuple(self.of(each, negated=negated) for each in parts))
            case _:
                return self.general.of(goal, {}, negated=negated)

    def _between(self, goal: Holds, links: _Links, start: str, end: str, negated: bool) -> Condition:
        if start == end and not links.is_acyclic:
            vocabulary = links.state.vocabulary
            what = f"`{format_condition(goal, vocabulary)}`, a chain of facts that leads back to where it begins"
            raise GoalError(f"the goal has {what}: planners do not follow such chains")
        moved = bool(links.movers(start if links.chains.at_start else end))
        steps = min(links.length.carriers + moved, MOST_STEPS)
        if start == end or not negated:
            known = start != end and end in links.fixed.forward.get(start)
            return And(()) if known else Or(()) if start == end else _chain(links, start, end, steps)
        return Not(_no_chain(links, start, end, steps)) if links.length.climbed else goal


def _no_chain(links: _Links, start: str, end: str, left: int) -> Condition:
    """Return that no chain with `left` changing steps at most leads from one individual to another."""
    at_start = links.chains.at_start
    movers = links.movers(start if at_start else end)
    if end in links.fixed.forward.get(start):
        return Or(())
    if not left or not movers:
        return And(())
    (mover,) = movers
    ways: list[Condition] = []
    for other in sorted(links.state.individuals - {mover}):
        step = links.step(mover, other) if at_start else links.step(other, mover)
        if step is not None:
            rest = _no_chain(links, *((other, end) if at_start else (start, other)), left - 1)
            ways += [And((step, rest))] if rest != Or(()) else []
    return Or(tuple(ways))


def _chain(links: _Links, start: str, end: str, left: int) -> Condition:
    """Return that a chain with 1 to `left` changing steps leads from one individual to another."""
    ways: list[Condition] = []
    reaching, at_start = links.fixed.backward.get(end), links.chains.at_start
    leaving, arriving = links.fixed.forward.get(start), links.state.individuals if left > 1 else reaching
    for over in sorted(leaving & links.moved if at_start else leaving) if left else ():
        for under in sorted(arriving if at_start else arriving & links.moved):
            step = links.step(over, under)
            if step is not None and under != over:
                rest = And(()) if under in reaching else _chain(links, under, end, left - 1)
                ways += [And((step, rest))] if rest != Or(()) else []
    return Or(tuple(ways))


def _unrolling(lengths: tuple[tuple[Chains, _Length], ...], vocabulary: Vocabulary) -> Unrolling:
    known = {each.relation: length for each, length in lengths}

    def depth(chains: Chains, cls: str) -> int:
        return known[chains.relation].steps_to(cls)

    climbed = frozenset(each.relation for each, length in lengths if length.climbed)
    return Unrolling({each.relation: each for each, _ in lengths}, depth, climbed, vocabulary)


@lru_cache(maxsize=64)
def _find_chains(key: LibraryKey, goal: Condition) -> tuple[Chains, ...]:
    return find_chains(key.library, goal)


@lru_cache(maxsize=4)
def _unroll_library(
    key: LibraryKey, vocabulary: VocabularyKey, lengths: tuple[tuple[Chains, _Length], ...]
) -> SkillLibrary:
    return unroll_library(key.library, _unrolling(lengths, vocabulary.vocabulary))


@lru_cache(maxsize=4)
def _stated_terms(key: VocabularyKey) -> StatedTerms:
    return StatedTerms.of(key.vocabulary)
