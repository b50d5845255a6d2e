"""One exploration of one body: its inputs, and what it has found so far."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol, TypeAlias

import msgspec
from msgspec import structs

from skillc_compiler.analysis.caller_terms import hide_names
from skillc_compiler.analysis.findings import BrokenHold, Finding, UnassignedRead, UnprovedPrecondition
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.apply_effects import apply_write, spare
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import NO_WRITES, Write
from skillc_compiler.analysis.paths import EndStates, Path, PathStep, StatePaths, extend_path, path_length
from skillc_compiler.analysis.summaries import WriteSummaries
from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, Requirement, TypedNode
from skillc_compiler.program.walk import conditions_in, reads_in, values_in
from skillc_dsl.source import Span
from skillc_model.conditions import Condition, Effect, Term
from skillc_model.traversal import free_variables

Explore: TypeAlias = Callable[["Exploration", TypedNode, StatePaths, "EvalContext"], EndStates]
FindUndeclared: TypeAlias = Callable[[Implementation], frozenset[Write]]


class EvalContext(msgspec.Struct, frozen=True):
    """The context of a node: whether its failure is caught, and what others may write while it runs.

    `parallel_writes` are those of them that siblings in a `par` make.
    """

    caught: bool = False
    concurrent_writes: frozenset[Write] = NO_WRITES
    parallel_writes: frozenset[Write] = NO_WRITES

    def with_failure_caught(self) -> EvalContext:
        """Return the same context with failures caught."""
        return structs.replace(self, caught=True)

    def with_concurrent_writes(self, writes: frozenset[Write]) -> EvalContext:
        """Return the same context with more writes by others."""
        return structs.replace(self, concurrent_writes=self.concurrent_writes | writes)

    def beside(self, writes: frozenset[Write]) -> EvalContext:
        """Return the same context with siblings in a `par` that write."""
        return structs.replace(self.with_concurrent_writes(writes), parallel_writes=self.parallel_writes | writes)


class PropertyMonitor(Protocol):
    """Follows an execution for a `verify` property; the `monitor` field of a state is its memory."""

    def list_numbers(self) -> frozenset[str]:
        """Return the properties of which it has to be known between which values they are."""
        ...

    def on_start(self, run: Exploration, state: State, path: PathStep, skill: str) -> State:
        """Return the state after a skill started."""
        ...

    def on_success(self, run: Exploration, state: State, skill: str) -> State:
        """Return the state after a skill succeeded."""
        ...

    def after_body(
        self, call: Call, before: State, state: State, path: PathStep
    ) -> Mapping[str, frozenset[tuple[int, bool]]]:
        """Return the possible memories after the body of a call, by outcome."""
        ...

    def observe(self, run: Exploration, states: StatePaths) -> dict[State, Path]:
        """Return the states between two nodes, with their memories updated."""
        ...

    def interleave(self, states: StatePaths, others: tuple[TypedNode, ...]) -> dict[State, Path]:
        """Return the states, each also as it is after what others may have done in parallel."""
        ...


@dataclass
class PreconditionStats:
    """How often a precondition was checked, was false and was open, with the paths.

    `excused` counts the times when it was open and need not be known: its failure is caught, or it is decided at run
    time. `uncaught` tells whether it was false where nothing catches that, as in the last round of a `retry`.
    """

    call: Call
    requirement: Requirement
    seen: int = 0
    false: int = 0
    open_: int = 0
    excused: int = 0
    uncaught: bool = False
    false_way: Path = None
    open_way: Path = None
    open_condition: Condition | None = None

    def count_false(self, caught: bool, path: Path) -> None:
        """Count that it is false; `caught` if the failure is."""
        if not self.false or path_length(path) < path_length(self.false_way):
            self.false_way = path
        self.false += 1
        self.uncaught |= not caught

    def count_open(self, condition: Condition, path: Path) -> None:
        """Count that it is open, and what is needed in the caller's terms."""
        if not self.open_ or path_length(path) < path_length(self.open_way):
            self.open_way, self.open_condition = path, condition
        self.open_ += 1


class CallEffect(msgspec.Struct, frozen=True):
    """An effect that a call had, in the caller's terms; `of_loop` if it is that of its rounds together."""

    call: Call
    post: Requirement
    effect: Effect
    of_loop: bool = False


@dataclass
class Exploration:
    """The inputs and results of exploring one body.

    `leaks` finds the undeclared changes of an implementation; `outputs` are the names that calls assign. While `quiet`
    is not 0, ends are computed and nothing is recorded. `steps` counts how often a node was followed from a state.
    `known` stores the ends of explored nodes by node, states and context, and whether they were recorded. `called` are
    the calls that were followed, so that states may know what they found. `always` is what is known as long as a `par`
    runs, by its node. `applied` are the effects that an `apply` has written. `rounds` is whether an individual has a
    round in a loop, by its node, in any of the states in which it started. `unsayable` are effects of rounds that are
    on two individuals of which each may be any. `items` are the variables of loops over lists, which stand for an item.
    """

    program: Program
    types: AliasTypes
    summaries: WriteSummaries
    implementation: Implementation | None
    leaks: FindUndeclared
    explore: Explore
    outputs: frozenset[str]
    stable: frozenset[str]
    monitor: PropertyMonitor | None = None
    found: dict[object, Finding] = field(default_factory=dict)
    reached: set[int] = field(default_factory=set)
    precondition_stats: dict[tuple[int, int], PreconditionStats] = field(default_factory=dict)
    effects: dict[object, CallEffect] = field(default_factory=dict)
    widened_at: Span | None = None
    quiet: int = 0
    steps: int = 0
    known: dict[object, tuple[bool, EndStates]] = field(default_factory=dict)
    always: dict[int, State] = field(default_factory=dict)
    applied: dict[Effect, tuple[TypedNode, Requirement]] = field(default_factory=dict)
    called: set[int] = field(default_factory=set)
    rounds: dict[tuple[int, Term], set[bool | None]] = field(default_factory=dict)
    unsayable: dict[object, CallEffect] = field(default_factory=dict)
    items: set[str] = field(default_factory=set)

    def writes(self, node: TypedNode) -> frozenset[Write]:
        """Return what a node may write; names whose meaning changes within the body stand for any individual."""
        return hide_names(self.summaries.writes_of_node(node, self.implementation), self.stable)

    def add_finding(self, key: object, finding: Finding, path: Path) -> None:
        """Record a finding; of several with the same key, the one with the shortest path."""
        known = self.found.get(key)
        if self.quiet:
            return
        if known is None or path_length(path) < path_length(getattr(known, "path", None)):
            self.found[key] = finding

    def check_reads(
        self, values: Iterable[TypedExpression], conditions: Iterable[TypedCondition], states: StatePaths
    ) -> None:
        """Record outputs that are read where they may have no value."""
        every = [part for value in values for part in reads_in(value)]
        inside = (condition for whole in conditions for condition in conditions_in(whole))
        every += [part for condition in inside for value in condition.values for part in values_in(value)]
        for value in every:
            names = free_variables(value.meaning) & self.outputs if not value.parts else frozenset[str]()
            for name in sorted(names):
                for path in [path for state, path in states.items() if name not in state.assigned]:
                    found = UnassignedRead(name, value.span, value.declared or value.span, path)
                    self.add_finding((value.span, name), found, path)

    def check_holds(self, state: State, path: Path, context: EvalContext) -> None:
        """Record holds of the implementation that may not hold when a node that takes time begins.

        What a sibling in a `par` may break is found where the sibling does it.
        """
        if self.implementation is None or path is None:
            return
        for hold in requirements_of(self.implementation, "hold"):
            condition = hold.condition.meaning
            known = evaluate(self.types, state, condition)
            if known is None and self._may_break_beside(condition, context):
                continue
            if known is not True:
                finding = BrokenHold(hold, path.span, known is False, path)
                self.add_finding((id(hold), path.span, known), finding, path)

    def _may_break_beside(self, condition: Condition, context: EvalContext) -> bool:
        held = assume(self.types, State(), condition)
        return held is not None and not evaluate(
            self.types, havoc(self.types, held, context.parallel_writes), condition
        )

    def check_holds_inside(self, call: Call, state: State, path: Path) -> None:
        """Record holds of the implementation that a call may break before it ends."""
        if self.implementation is None:
            return
        for hold in requirements_of(self.implementation, "hold"):
            condition = hold.condition.meaning
            if not evaluate(self.types, state, condition):
                continue
            for write in self.summaries.early_writes_of_call(call):
                if not evaluate(self.types, apply_write(self.types, state, spare(self.types, state, write)), condition):
                    span = call.written.span
                    trail = extend_path(path, span, f"`{call.written.skill.text}` has still to do more")
                    self.add_finding((id(hold), span, None), BrokenHold(hold, span, False, trail), trail)

    def count_precondition(
        self,
        call: Call,
        requirement: Requirement,
        condition: Condition,
        known: bool | None,
        excused: bool,
        path: Path,
    ) -> None:
        """Count what is known of a precondition at the start of its skill."""
        if self.quiet:
            return
        key = (id(call), id(requirement))
        count = self.precondition_stats.setdefault(key, PreconditionStats(call, requirement))
        count.seen += 1
        if known is False:
            count.count_false(excused, path)
        elif known is None and excused:
            count.excused += 1
        elif known is None:
            count.count_open(condition, path)

    def unproved_preconditions(self) -> Iterable[Finding]:
        """Yield the preconditions that are false or open on some path; if failure is caught, false on all."""
        for count in self.precondition_stats.values():
            if count.false == count.seen or count.uncaught:
                always = count.false == count.seen and count.uncaught
                yield UnprovedPrecondition(count.call, count.requirement, True, count.false_way, always)
            elif count.open_ and self.implementation is not None:
                yield UnprovedPrecondition(
                    count.call, count.requirement, False, count.open_way, condition=count.open_condition
                )


def havoc_concurrent(run: Exploration, state: State, context: EvalContext) -> State:
    """Return what is still known while others write."""
    return havoc(run.types, state, context.concurrent_writes) if context.concurrent_writes else state


def explore_sequence(
    run: Exploration, children: Sequence[TypedNode], states: StatePaths, context: EvalContext
) -> EndStates:
    """Return how children that run one after the other end."""
    ends = EndStates(success=dict(states))
    for child in children:
        one = run.explore(run, child, ends.success, context)
        ends.success = one.success
        ends.add_failures(one)
    return ends


def interleave(run: Exploration, states: StatePaths, *others: TypedNode) -> StatePaths:
    """Return the states with other nodes running in parallel, as far as a monitored property distinguishes them."""
    return run.monitor.interleave(states, others) if run.monitor is not None else states
