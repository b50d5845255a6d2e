"""The proof of a whole program: each body is explored once, called skills before their callers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import islice
from typing import TypeAlias, TypeVar

import msgspec
from msgspec import structs

from skillc_compiler.analysis import end_states
from skillc_compiler.analysis.applied import early_applies
from skillc_compiler.analysis.effects.universals import Universals
from skillc_compiler.analysis.effects.unnamed import with_passed, with_taken
from skillc_compiler.analysis.exploration import EvalContext, Exploration
from skillc_compiler.analysis.findings import (
    Finding,
    Remedy,
    TooManyStates,
    UnassignedOutput,
    UnassignedRead,
    UndecidedProperty,
    UnprovedPrecondition,
    UnreachableNode,
    ViolatedProperty,
)
from skillc_compiler.analysis.initial_state import can_start, declare_names, initial_state, parameter_state
from skillc_compiler.analysis.interfaces import Interface, summarise
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms, build_axioms
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.sameness import CalledPrimitive, Proved
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import NO_WRITES, Write, normalise_each
from skillc_compiler.analysis.nodes import explore
from skillc_compiler.analysis.parallel_conflicts import find_parallel_conflicts
from skillc_compiler.analysis.paths import EndStates, leads_through
from skillc_compiler.analysis.remedies import add_remedies
from skillc_compiler.analysis.scopes import leaked_scopes
from skillc_compiler.analysis.summaries import WriteSummaries
from skillc_compiler.analysis.verify_monitor import VerifyMonitor
from skillc_compiler.program.called import called_by, may_run_one_that_runs_it, run_by
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Let, Task, Test, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.query import Memo
from skillc_dsl.source import Span
from skillc_model.conditions import ForEach
from skillc_rdf.vocabulary.types import Vocabulary

F = TypeVar("F", bound=Finding)


class Proof(msgspec.Struct, frozen=True):
    """The findings in one body; an implementation has an interface, which its callers read.

    `vocabulary` writes the terms of the library without a prefix, as its author does.
    """

    of: Implementation | Task
    findings: tuple[Finding, ...]
    vocabulary: Vocabulary
    interface: Interface | None = None


Proofs: TypeAlias = Mapping[str, Proof]
"""The proof of each compound implementation, and of each task with a body, by its key."""


def prove(program: Program, prover: Prover) -> Proofs:
    """Return the proofs of the bodies of a program, or of one file of it, in the order of its declarations."""
    for implementation in program.implementations:
        prover.prove_implementation(implementation)
    for task in program.tasks:
        prover.prove_task(task)
    keys = (each.key for part in (program.implementations, program.tasks) for each in part)
    return {key: prover.proofs[key] for key in keys if key in prover.proofs}


def findings_of(proofs: Proofs, kind: type[F]) -> Iterator[F]:
    """Yield the findings of a kind in all bodies."""
    for proof in proofs.values():
        yield from (finding for finding in proof.findings if isinstance(finding, kind))


@dataclass
class Prover:
    """Computes the proofs of a whole program on demand.

    A proof in the memo is reused if neither the body nor the interface of anything that it calls has changed.
    """

    program: Program
    memo: Memo = field(default_factory=Memo)
    proofs: dict[str, Proof] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._axioms: CanonicalAxioms = build_axioms(self.program.vocabulary)
        self.summaries = WriteSummaries(self.program, self._axioms)
        self._interfaces: dict[str, Interface] = {}
        self._busy: set[str] = set()
        self._written = _without_own_prefix(self.program)

    def leaks(self, implementation: Implementation) -> frozenset[Write]:
        """Return what an implementation changes beyond its postconditions when it succeeds."""
        if not isinstance(implementation.body, TypedNode) or implementation.key in self._busy:
            return NO_WRITES
        return self._interface(implementation, implementation.body).leaks

    def prove_implementation(self, implementation: Implementation) -> None:
        """Prove the body of an implementation, if it has one."""
        if isinstance(implementation.body, TypedNode):
            self._interface(implementation, implementation.body)

    def prove_task(self, task: Task) -> None:
        """Prove the body of a task; what comes of that of a test is found out by running it, a failure included."""
        if task.body is not None and not isinstance(task, Test):
            self.proofs[task.key] = self._recall(task, partial(self._prove_task, task, task.body))

    def _interface(self, of: Implementation, body: TypedNode) -> Interface:
        """Return what callers read of an implementation: the same object as in the analysis before if it is equal."""
        if of.key not in self._interfaces:
            self._interfaces[of.key] = self.memo.same("interface", of.key, self._find_interface(of, body))
        return self._interfaces[of.key]

    def _find_interface(self, of: Implementation, body: TypedNode) -> Interface:
        self._busy.add(of.key)
        proof = self._recall(of, partial(self._prove_implementation, of, body))
        self._busy.discard(of.key)
        self.proofs[of.key] = proof
        assert proof.interface is not None, "an implementation has one"
        return proof.interface

    def _read_by_callers(self, of: Implementation) -> Interface | CalledPrimitive:
        if isinstance(of.body, TypedNode):
            return self._interface(of, of.body)
        return self.memo.same("primitive", of.key, CalledPrimitive(of))

    def _prove_task(self, task: Task, body: TypedNode) -> Proof:
        run = self.new_exploration(task, body)
        run.explore(run, body, {State(): None}, EvalContext())
        return Proof(task, self._all_findings(task, body, run, ()), self._written)

    def _recall(self, of: Implementation | Task, compute: Callable[[], Proof]) -> Proof:
        """Return the known proof of a body.

        That of one which runs others that run it depends on the order, and is not reused.
        """
        if isinstance(of, Implementation) and may_run_one_that_runs_it(self.program, of):
            return compute()
        called = (self._read_by_callers(one) for one in called_by(self.program, of) if one.key != of.key)
        follows = run_by(self.program, of) if isinstance(of, Implementation) and of.verify else ()
        kept = self.memo.same("proved", of.key, Proved(of))
        proof = self.memo.ask("proof", (kept, self.program.vocabulary, *called, *follows), compute)
        return proof if proof.of is of else structs.replace(proof, of=of)

    def new_exploration(self, of: Implementation | Task, body: TypedNode) -> Exploration:
        """Return a new exploration of a body."""
        types = AliasTypes(self.program.vocabulary, self._axioms)
        implementation = of if isinstance(of, Implementation) else None
        lets: tuple[Let, ...] = implementation.lets if implementation else ()
        declare_names(types, of)
        stable = {let.name.text for let in lets} | {p.name for p in of.parameters if p.direction != "out"}
        outputs = {node.call.out.text for node in nodes_in(body) if node.call and node.call.out}
        outputs |= {p.name for p in of.parameters if p.direction == "out"}
        return Exploration(
            program=self.program,
            types=types,
            summaries=self.summaries,
            implementation=implementation,
            leaks=self.leaks,
            explore=explore,
            outputs=frozenset(outputs) - stable,
            stable=frozenset(stable),
        )

    def _prove_implementation(self, implementation: Implementation, body: TypedNode) -> Proof:
        run = self.new_exploration(implementation, body)
        start = initial_state(run.types, implementation, self.summaries.all_writes(implementation))
        ends = explore(run, body, {start: None}, EvalContext())
        stuck = stuck_calls(run.unproved_preconditions())
        ended = {state: path for state, path in ends.success.items() if not leads_through(path, stuck)}
        ends = replace(ends, success=ended)
        before = start, *end_states.declared_states(run, implementation, start)
        assuming = partial(self._explore_assuming, implementation, body)
        universals = Universals(run, start, assuming)
        end_findings = (
            *end_states.end_findings(run, implementation, before, ends, universals),
            *self._verify_findings(implementation, body, start, stuck),
        )
        leaks = end_states.undeclared_writes(run, implementation, before, ends)
        interface = summarise(self.summaries, implementation, leaks)
        found = self._all_findings(implementation, body, run, end_findings)
        remedied = tuple(add_remedies(run, implementation, found, ends, universals))
        return Proof(implementation, remedied, self._written, interface)

    def _explore_assuming(
        self, implementation: Implementation, body: TypedNode, remedy: Remedy
    ) -> tuple[Exploration, EndStates]:
        """Explore a body again as if its skill had a remedy; of its postconditions, those on many."""
        run = self.new_exploration(implementation, body)
        classes = {**dict(remedy.parameters), **({remedy.some.name: remedy.some.cls} if remedy.some else {})}
        run.types.classes.update(classes)
        run.stable |= classes.keys()
        body = body if remedy.some is None else with_taken(body, remedy.some)
        if remedy.call is not None:
            body = with_passed(body, remedy.call, {each: run.types.classes[each] for each in remedy.passed})
        start = initial_state(run.types, implementation, self.summaries.all_writes(implementation))
        promised = frozenset(normalise_each(each) for each in remedy.after if isinstance(each, ForEach))
        start = start.replace(unchanged=start.unchanged | promised)
        for condition in (*remedy.required, *((remedy.some.where,) if remedy.some else ())):
            start = assume(run.types, start, condition) or start
        return run, explore(run, body, {start: None}, EvalContext())

    def _verify_findings(
        self, implementation: Implementation, body: TypedNode, start: State, stuck: frozenset[Span]
    ) -> Iterator[Finding]:
        for line in implementation.verify:
            run = self.new_exploration(implementation, body)
            run.monitor = monitor = VerifyMonitor(
                line, self.program, self.summaries, self.new_exploration, start, stuck
            )
            ends = explore(run, body, {start: None}, EvalContext())
            monitor.on_end(run, ends.success)
            monitor.observe(run, ends.failed)
            if monitor.broken is not None:
                yield ViolatedProperty(line, monitor.broken)
            elif monitor.open_ or run.widened_at is not None:
                yield UndecidedProperty(line)

    def _all_findings(
        self, of: Implementation | Task, body: TypedNode, run: Exploration, end_findings: tuple[Finding, ...]
    ) -> tuple[Finding, ...]:
        found = [
            *run.found.values(),
            *run.unproved_preconditions(),
            *unreachable_nodes(run, body, parameter_state(of) if isinstance(of, Implementation) else State()),
            *find_parallel_conflicts(run, body),
            *leaked_scopes(of, body),
            *(early_applies(of, body) if isinstance(of, Implementation) else ()),
            *end_findings,
        ]
        if run.widened_at is not None:
            found.append(TooManyStates(run.widened_at))
        if isinstance(of, Implementation) and not can_start(run.types, of):
            return tuple(each for each in found if isinstance(each, UnassignedRead | UnassignedOutput))
        return tuple(_without_consequences(found))


def _without_own_prefix(program: Program) -> Vocabulary:
    """Return the vocabulary with an empty prefix for the terms of the library."""
    own = {unit.namespace for unit in program.files if unit.library == program.name}
    prefixes = {prefix: base for prefix, base in program.vocabulary.prefixes.items() if base not in own}
    prefixes.update(("", base) for base in own)
    return structs.replace(program.vocabulary, prefixes=prefixes)


def _without_consequences(found: Sequence[Finding]) -> Iterator[Finding]:
    """Yield the findings that are not on a path through a call that never starts."""
    stuck = stuck_calls(found)
    yield from (each for each in found if not leads_through(getattr(each, "path", None), stuck))


def stuck_calls(found: Iterable[Finding]) -> frozenset[Span]:
    """Return the places of the calls that never start, since a precondition is false whenever they begin."""
    never = (each for each in found if isinstance(each, UnprovedPrecondition) and each.always)
    return frozenset(each.call.written.span for each in never)


def unreachable_nodes(run: Exploration, node: TypedNode, start: State) -> Iterator[UnreachableNode]:
    """Yield the nodes that never start: the outer one of nested nodes, the first one of consecutive nodes.

    A branch whose condition is always true or false is reported as such a condition.
    """
    if id(node) not in run.reached:
        yield UnreachableNode(node)
        return
    if isinstance(node.written, s.If | s.While) and evaluate(run.types, start, node.conditions[0].meaning) is not None:
        return
    for children in (node.children, node.orelse):
        never = (child for child in children if id(child) not in run.reached)
        yield from (UnreachableNode(child) for child in islice(never, 1))
        for child in children:
            if id(child) in run.reached:
                yield from unreachable_nodes(run, child, start)
