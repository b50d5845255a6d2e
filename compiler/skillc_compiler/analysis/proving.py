"""The proof of a whole program: each body explored once, called skills before those that call them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TypeVar

from skillc_compiler.analysis import ending
from skillc_compiler.analysis.axioms import Axioms, axioms_of
from skillc_compiler.analysis.clashes import clashes
from skillc_compiler.analysis.exploring import explore
from skillc_compiler.analysis.findings import Finding, Undecided, Unreachable, Unverified, Violated
from skillc_compiler.analysis.lasting import lasting
from skillc_compiler.analysis.opening import can_start, name_sorts, opening, unconditional
from skillc_compiler.analysis.run import NOWHERE, Around, Run
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import Summaries
from skillc_compiler.analysis.truth import truth
from skillc_compiler.analysis.understood import Understood
from skillc_compiler.analysis.watching import PropertyWatch
from skillc_compiler.analysis.writes import Write
from skillc_compiler.program.typed import Implementation, Let, Program, Task, TypedNode
from skillc_compiler.program.walk import within
from skillc_dsl import syntax as s

F = TypeVar("F", bound=Finding)


@dataclass(frozen=True)
class Proof:
    """What was found in one body. `leaks` is what it changes without its description saying so."""

    of: Implementation | Task
    findings: tuple[Finding, ...]
    leaks: frozenset[Write] = NOWHERE


@lru_cache(maxsize=1)
def proofs(program: Program) -> Mapping[str, Proof]:
    """Return the proof of each compound implementation by its key, and of each task with a body by `task NAME`."""
    prover = Prover(program)
    for implementation in program.implementations:
        prover.leaks(implementation)
    for task in program.tasks:
        prover.task(task)
    return prover.done


def found(program: Program, kind: type[F]) -> Iterator[F]:
    """Yield the findings of a kind in all bodies."""
    for proof in proofs(program).values():
        yield from (finding for finding in proof.findings if isinstance(finding, kind))


@dataclass
class Prover:
    """Works out proofs as they are asked for."""

    program: Program
    done: dict[str, Proof] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._axioms: Axioms = axioms_of(self.program.vocabulary)
        self.summaries = Summaries(self.program, self._axioms)
        self.understood = Understood(self.program, self._axioms)
        self._busy: set[str] = set()

    def leaks(self, implementation: Implementation) -> frozenset[Write]:
        """Return what an implementation changes beyond its postconditions when it succeeds."""
        if not isinstance(implementation.body, TypedNode) or implementation.key in self._busy:
            return NOWHERE
        if implementation.key not in self.done:
            self._busy.add(implementation.key)
            self.done[implementation.key] = self._implementation(implementation, implementation.body)
            self._busy.discard(implementation.key)
        return self.done[implementation.key].leaks

    def task(self, task: Task) -> None:
        """Prove the body of a task."""
        if task.body is not None:
            run = self.run(None, task.body)
            run.explore(run, task.body, {State(): None}, Around())
            findings = self._kept(task, task.body, run, ())
            self.done[f"task {task.name}"] = Proof(task, findings)

    def run(self, implementation: Implementation | None, body: TypedNode) -> Run:
        """Return a fresh exploration."""
        sorts = Sorts(self.program.vocabulary, self._axioms)
        lets: tuple[Let, ...] = implementation.lets if implementation else ()
        stable = {let.name.text for let in lets}
        outputs = {step.call.out.text for step in within(body) if step.call and step.call.out}
        if implementation is not None:
            name_sorts(sorts, implementation)
            stable |= {p.name for p in implementation.parameters if p.direction != "out"}
            outputs |= {p.name for p in implementation.parameters if p.direction == "out"}
        return Run(
            program=self.program,
            sorts=sorts,
            summaries=self.summaries,
            implementation=implementation,
            leaks=self.leaks,
            explore=explore,
            outputs=frozenset(outputs) - stable,
            stable=frozenset(stable),
        )

    def _implementation(self, implementation: Implementation, body: TypedNode) -> Proof:
        run = self.run(implementation, body)
        start = opening(run.sorts, implementation)
        ends = explore(run, body, {start: None}, Around())
        told = tuple(ending.findings(run, implementation, start, ends))
        told = (*told, *self._verified(implementation, body, start))
        leaks = ending.leaks(run, implementation, start, ends)
        return Proof(implementation, self._kept(implementation, body, run, told), leaks)

    def _verified(self, implementation: Implementation, body: TypedNode, start: State) -> Iterator[Finding]:
        for line in implementation.verify:
            run = self.run(implementation, body)
            run.watch = watch = PropertyWatch(line, self.program, self.summaries, self.run)
            ends = explore(run, body, {start: None}, Around())
            watch.ended(run, ends.success)
            watch.sees(run, ends.failed)
            if watch.broken is not None:
                yield Violated(line, watch.broken)
            elif watch.open_ or run.crowded is not None:
                yield Unverified(line)

    def _kept(
        self, of: Implementation | Task, body: TypedNode, run: Run, told: tuple[Finding, ...]
    ) -> tuple[Finding, ...]:
        found = [
            *run.found.values(),
            *run.unguaranteed(),
            *unreachable(run, body, unconditional(of) if isinstance(of, Implementation) else State()),
            *clashes(self.program, self.summaries, self._axioms, body),
            *lasting(of, body),
            *told,
        ]
        if run.crowded is not None:
            found.append(Undecided(run.crowded))
        clear = not isinstance(of, Implementation) or can_start(run.sorts, of)
        return tuple(self.understood.sound(of, found, clear))


def unreachable(run: Run, node: TypedNode, start: State) -> Iterator[Unreachable]:
    """Yield the nodes that never start, of those inside each other the outer, of those after each other the first.

    A branch whose condition is decided whatever is required is told as such a condition.
    """
    if id(node) not in run.reached:
        yield Unreachable(node)
        return
    if isinstance(node.written, s.If | s.While) and truth(run.sorts, start, node.clauses[0].meaning) is not None:
        return
    for children in (node.children, node.orelse):
        never = [child for child in children if id(child) not in run.reached]
        yield from (Unreachable(child) for child in never[:1])
        for child in children:
            if child not in never:
                yield from unreachable(run, child, start)
