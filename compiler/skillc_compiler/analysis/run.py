"""One exploration of one body: what it needs to know, and what it has found so far."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol, TypeAlias

from skillc_compiler.analysis.findings import BrokenHold, Finding, Unassigned, Unguaranteed
from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.opening import requirements_of
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import Summaries, hidden
from skillc_compiler.analysis.trail import Ends, Trail, Way, Ways, length
from skillc_compiler.analysis.truth import truth
from skillc_compiler.analysis.writes import Write
from skillc_compiler.program.typed import (
    Call,
    Implementation,
    Program,
    Requirement,
    TypedCondition,
    TypedExpression,
    TypedNode,
)
from skillc_compiler.program.walk import clauses_in, values_in
from skillc_dsl.source import Span
from skillc_model.conditions import Effect
from skillc_model.reading import free_variables

Explore: TypeAlias = Callable[["Run", TypedNode, Ways, "Around"], Ends]
Leaks: TypeAlias = Callable[[Implementation], frozenset[Write]]
NOWHERE: frozenset[Write] = frozenset()


@dataclass(frozen=True)
class Around:
    """Where a node stands: whether its failure is dealt with, and what others may write while it runs."""

    caught: bool = False
    disturbing: frozenset[Write] = NOWHERE

    def catching(self) -> Around:
        """Return the same place where a failure is dealt with."""
        return replace(self, caught=True)

    def beside(self, writes: frozenset[Write]) -> Around:
        """Return the same place where others write besides."""
        return replace(self, disturbing=self.disturbing | writes)


class Watch(Protocol):
    """Follows what happens, for a `verify` property; a state's `monitor` is what it remembers."""

    def starts(self, run: Run, state: State, way: Trail, skill: str) -> State:
        """Return the state after a skill started."""
        ...

    def succeeds(self, run: Run, state: State, skill: str) -> State:
        """Return the state after a skill succeeded."""
        ...

    def inside(self, call: Call, before: State, state: State, way: Trail) -> Mapping[str, frozenset[tuple[int, bool]]]:
        """Return what may be remembered after the body of a call, by how it ends."""
        ...

    def sees(self, run: Run, ways: Ways) -> dict[State, Way]:
        """Return the states between two nodes."""
        ...

    def beside(self, ways: Ways, others: tuple[TypedNode, ...]) -> dict[State, Way]:
        """Return the states, each also as it is after what others may have done meanwhile."""
        ...


@dataclass
class Tally:
    """How often a precondition was looked at, and how often it did not hold or was not known to, with the ways.

    `excused` are those times that it was not known and need not be: where failure is dealt with, or at run time.
    """

    call: Call
    requirement: Requirement
    seen: int = 0
    false: int = 0
    open_: int = 0
    excused: int = 0
    caught: bool = False
    false_way: Way = None
    open_way: Way = None


@dataclass(frozen=True, slots=True)
class Effected:
    """An effect that a call had, in the caller's words."""

    call: Call
    post: Requirement
    effect: Effect


@dataclass
class Run:
    """`leaks` tells what an implementation changes without saying so; `outputs` are names that calls assign.

    While `quiet` is not 0, ends are worked out and nothing is noted. `steps` counts how often a node was followed from
    a state; `known` holds how nodes end that were followed already, by node, states and place, and whether that was
    noted.
    """

    program: Program
    sorts: Sorts
    summaries: Summaries
    implementation: Implementation | None
    leaks: Leaks
    explore: Explore
    outputs: frozenset[str]
    stable: frozenset[str]
    watch: Watch | None = None
    found: dict[object, Finding] = field(default_factory=dict)
    reached: set[int] = field(default_factory=set)
    tallies: dict[tuple[int, int], Tally] = field(default_factory=dict)
    effects: dict[object, Effected] = field(default_factory=dict)
    crowded: Span | None = None
    quiet: int = 0
    steps: int = 0
    known: dict[object, tuple[bool, Ends]] = field(default_factory=dict)

    def writes(self, step: TypedNode) -> frozenset[Write]:
        """Return what a node may write; names that change their meaning within the body stand for anything fitting."""
        return hidden(self.summaries.of_step(step, self.implementation), self.stable)

    def note(self, key: object, finding: Finding, way: Way) -> None:
        """Keep a finding, the one with the shortest way of several."""
        known = self.found.get(key)
        if self.quiet:
            return
        if known is None or length(way) < length(getattr(known, "way", None)):
            self.found[key] = finding

    def read(self, values: Iterable[TypedExpression], clauses: Iterable[TypedCondition], ways: Ways) -> None:
        """Look whether outputs that are read have a value."""
        every = [part for value in values for part in values_in(value)]
        every += [
            part for whole in clauses for clause in clauses_in(whole) for v in clause.values for part in values_in(v)
        ]
        for value in every:
            names = free_variables(value.meaning) & self.outputs if not value.parts else frozenset[str]()
            for name in sorted(names):
                for way in [way for state, way in ways.items() if name not in state.assigned]:
                    self.note((value.span, name), Unassigned(name, value.span, way), way)

    def watch_holds(self, state: State, way: Way) -> None:
        """Something that takes time begins: the implementation's own holds must still hold."""
        if self.implementation is None or way is None:
            return
        for hold in requirements_of(self.implementation, "hold"):
            known = truth(self.sorts, state, hold.clause.meaning)
            if known is not True:
                finding = BrokenHold(hold, way.span, known is False, way)
                self.note((id(hold), way.span, known), finding, way)

    def tally(self, call: Call, requirement: Requirement, known: bool | None, excused: bool, way: Way) -> None:
        """Count what is known of a precondition where its skill starts."""
        if self.quiet:
            return
        key = (id(call), id(requirement))
        count = self.tallies.setdefault(key, Tally(call, requirement))
        count.seen += 1
        if known is False:
            count.caught |= excused
            count.false_way = way if not count.false or length(way) < length(count.false_way) else count.false_way
            count.false += 1
        elif known is None and excused:
            count.excused += 1
        elif known is None:
            count.open_way = way if not count.open_ or length(way) < length(count.open_way) else count.open_way
            count.open_ += 1

    def unguaranteed(self) -> Iterable[Finding]:
        """Yield the preconditions that do not hold on some way or are not known to; where failure is caught, on all."""
        for count in self.tallies.values():
            if count.false == count.seen or (count.false and not count.caught):
                yield Unguaranteed(count.call, count.requirement, True, count.false_way)
            elif count.open_ and self.implementation is not None:
                yield Unguaranteed(count.call, count.requirement, False, count.open_way)


def disturbed(run: Run, state: State, around: Around) -> State:
    """Return what is still known while others write."""
    return forgotten(run.sorts, state, around.disturbing) if around.disturbing else state


def in_order(run: Run, children: Sequence[TypedNode], ways: Ways, around: Around) -> Ends:
    """Return how children one after the other end."""
    ends = Ends(success=dict(ways))
    for child in children:
        one = run.explore(run, child, ends.success, around)
        ends.success = one.success
        ends.add_failures(one)
    return ends


def mixed(run: Run, ways: Ways, *others: TypedNode) -> Ways:
    """Return the states where others run beside, as far as a watched property tells them apart."""
    return run.watch.beside(ways, others) if run.watch is not None else ways
