"""What is proved of random bodies is never contradicted by the engine that runs them.

10 libraries with 3 compounds each by default; `COMPOUNDS` in the environment is the number of compounds.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from random import Random

import pytest

from analysis.actors import ITEMS, NS, SPOTS, Chance, world
from analysis.numbers import Numbers
from analysis.plays import COMPOUNDS, Writer
from skillc_compiler.analysis.exploration import EvalContext, Exploration
from skillc_compiler.analysis.findings import (
    BrokenHold,
    UndecidedProperty,
    UnprovedPost,
    ViolatedProperty,
)
from skillc_compiler.analysis.initial_state import can_start, initial_state, requirements_of
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.paths import EndStates
from skillc_compiler.analysis.proof import Prover
from skillc_compiler.checks import find_all, load_checks
from skillc_compiler.lower.library import lower_program
from skillc_compiler.program.marks import Marks, Need
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_compiler.resolve.files import read_sources
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.position import Position
from skillc_dsl.source import Source
from skillc_model import tree
from skillc_model.conditions import Condition, Given, Holds, Individual, Variable
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, ImplementationChosen, NodeEnded, NodeStarted
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.world_state import WorldState

LIBRARIES = int(os.environ.get("COMPOUNDS", "30")) // COMPOUNDS
RUNS, TICKS = 6, 60


@dataclass
class Claims:
    """What a proof says of one implementation, by the places the engine speaks of."""

    implementation: Implementation
    exploration: Exploration
    ends: Sequence[EndStates]
    posts: set[Position]
    holds: set[Position]
    guaranteed: set[tuple[Position, Position]]
    never: set[Position]
    properties: list[int]


@dataclass
class Seen:
    """The events of one run, and the world when its first node ended, before anything is undone at the end."""

    cell: Chance
    events: list[Event] = field(default_factory=list)
    last: WorldState | None = None

    def __call__(self, event: Event) -> None:
        self.events.append(event)
        if isinstance(event, NodeEnded) and event.node == 1:
            self.last = self.cell.world.snapshot()


def understood(text: str) -> Program:
    """Return the program that a text means, which must be understood whole."""
    files = read_sources([Source("play.skill", text)], {}, "play")
    program = resolve_program(files.value, Vocabulary(), "play", {})
    assert (files.diagnostics, program.diagnostics) == ((), ()), text
    return program.value


def marks_of(prover: Prover) -> Marks:
    """Return what is not free of errors in a program."""
    found = find_all(prover.program, prover.memo)
    below = (problem for one in load_checks() if one.NEEDS < Need.BODY for problem in found[one.__name__])
    return Marks(prover.program, below)


def is_sound(marks: Marks, implementation: Implementation, run: Exploration) -> bool:
    """Whether what is proved of an implementation is reported: there is no error in it nor in what it calls."""
    about = Diagnostic("a-claim", implementation.name_span, "something is proved")
    return marks.allow(Need.BODY, about) and can_start(run.types, implementation)


def claims_of(prover: Prover, marks: Marks, implementation: Implementation, body: TypedNode) -> Claims:
    """Explore a body and return everything that is claimed of it."""
    run = prover.new_exploration(implementation, body)
    prover.leaks(implementation)
    ends = run.explore(run, body, {initial_state(run.types, implementation): None}, EvalContext())
    watched = prover.new_exploration(implementation, body)
    watched.monitor = Numbers(frozenset({f"{NS}level"}))
    start = initial_state(watched.types, implementation)
    several = ends, watched.explore(watched, body, {start: None}, EvalContext())
    findings = prover.proofs[implementation.key].findings
    if not is_sound(marks, implementation, run):
        return Claims(implementation, run, several, set(), set(), set(), set(), [])
    unproved = {f.post.span for f in findings if isinstance(f, UnprovedPost)}
    broken = {f.hold.span for f in findings if isinstance(f, BrokenHold)}
    open_ = {f.property.span for f in findings if isinstance(f, ViolatedProperty | UndecidedProperty)}
    sure = [
        t
        for t in run.precondition_stats.values()
        if t.requirement.kind == "pre" and not (t.false or t.open_ or t.excused)
    ]
    return Claims(
        implementation,
        run,
        several,
        {p.span.start for p in requirements_of(implementation, "post") if p.span not in unproved},
        {h.span.start for h in requirements_of(implementation, "hold") if h.span not in broken},
        {(t.call.written.span.start, t.requirement.span.start) for t in sure},
        {s.written.span.start for s in nodes_in(body) if id(s) not in run.reached},
        [n for n, line in enumerate(implementation.verify) if line.span not in open_],
    )


@pytest.mark.slow
@pytest.mark.parametrize("block", range(10))
def test_what_is_proved_holds_when_it_runs(block: int) -> None:
    started = 0
    for seed in range(block, LIBRARIES, 10):
        text = Writer(Random(seed)).library()
        program = understood(text)
        prover = Prover(program)
        marks = marks_of(prover)
        claims = [
            claims_of(prover, marks, one, one.body)
            for one in program.implementations
            if isinstance(one.body, TypedNode)
        ]
        assert claims
        library = lower_program(program, ())
        for claim in claims:
            for number in range(RUNS):
                started += played(library, claims, claim, Random(f"{seed} {number}"), f"seed {seed}\n{text}")
    assert started > 0


def played(library: SkillLibrary, claims: list[Claims], claim: Claims, random: Random, told: str) -> bool:
    """Run one implementation in a random world; return whether it started."""
    bindings: dict[str, str] = {name: random.choice(ITEMS) for name in "ab"} | {n: random.choice(SPOTS) for n in "st"}
    name = claim.implementation.skill.name
    arguments = {key: Individual(value) for key, value in bindings.items()}
    call = tree.Call(name, None, arguments, None, Position("test", 1, 1))  # type: ignore[arg-type]
    cell = Chance(world(library.vocabulary, random), random)
    seen = Seen(cell)
    engine = TreeRun(call, library, cell, [seen])  # type: ignore[arg-type]
    for tick in range(TICKS):
        cell.now = tick * 0.05
        if engine.tick() is not Status.RUNNING:
            break
    else:
        engine.halt("enough")
    chosen = [e for e in seen.events if isinstance(e, ImplementationChosen)]
    if not chosen or chosen[0].skill != name:
        return False
    for one in claims:
        contradicted(one, seen.events, told)
    if engine.status in (Status.SUCCESS, Status.FAILURE):
        for ends in claim.ends if not stopped(engine.failure, name) else ():
            states = ends.success if engine.status is Status.SUCCESS else ends.failed
            assert any(agrees(state, seen.last, bindings) for state in states), (
                engine.status,
                engine.failure,
                name,
                told,
            )
        keeps(claim, seen.events, engine.status is Status.SUCCESS, told)
    return True


def stopped(failure: Failure | None, skill: str) -> bool:
    """Whether a skill did not end by itself, but because of what is said of it."""
    return failure is not None and failure.skill == skill and failure.kind in ("post", "hold", "verify")


def contradicted(claim: Claims, events: list[Event], told: str) -> None:
    """Check every failure and every start against what was claimed of one implementation."""
    active: dict[int, str] = {}
    sources: dict[int, Position] = {}
    for event in events:
        if isinstance(event, NodeStarted):
            active[event.node], sources[event.node] = "", event.source
            assert event.source not in claim.never, ("never starts", event, told)
        elif isinstance(event, ImplementationChosen):
            active[event.node] = event.skill
            refused(claim, sources[event.node], [each.source for each in event.rejected if each.stage == "pre"], told)
        elif isinstance(event, NodeEnded) and event.failure is not None:
            failure = event.failure
            if failure.kind == "post":
                assert failure.source not in claim.posts, ("post", failure, told)
            if failure.kind == "hold" and active.get(event.node) == claim.implementation.skill.name:
                assert failure.source not in claim.holds, ("hold", failure, told)
            if failure.kind == "pre" and not active.get(event.node):
                causes = [each.source for each in (failure, *failure.causes) if each.kind == "pre"]
                refused(claim, sources[event.node], causes, told)


def refused(claim: Claims, at: Position, needs: list[Position | None], told: str) -> None:
    for need in needs:
        assert (at, need) not in claim.guaranteed, ("precondition", at, need, told)


def agrees(state: State, now: WorldState | None, bindings: dict[str, str]) -> bool:
    """Whether the world is one of those that a state describes, as far as it speaks of the parameters."""
    assert now is not None, "a run that ended has a last world"
    return all(evaluate(fact, now, bindings) == true for fact, true in facts(state, bindings))


def facts(state: State, bindings: dict[str, str]) -> Iterator[tuple[Condition, bool]]:
    """Yield what a state says of the parameters."""
    for fact, true in state.facts.items():
        if free_variables(fact) <= bindings.keys() and not isinstance(fact, Given):
            yield fact, true
    for (relation, thing, is_subject), others in state.possible.items():
        names = {thing, *others}
        if all(isinstance(name, Variable) and name.name in bindings for name in names):
            allowed = {bindings[other.name] for other in others if isinstance(other, Variable)}
            for item in (*ITEMS, *SPOTS):
                if item not in allowed:
                    other = Individual(item)
                    yield (Holds(thing, relation, other) if is_subject else Holds(other, relation, thing)), False


def keeps(claim: Claims, events: list[Event], success: bool, told: str) -> None:
    """Check the properties that were proved of the implementation that ran."""
    lines = claim.implementation.verify
    for number in claim.properties:
        line = lines[number]
        if line.first.skill is not None:
            second = line.second.skill if line.second is not None else None
            broken = violated(line.pattern, line.first.skill, second, events, success)
            assert not broken, ("verify", line.text, told)


def violated(pattern: str, first: str, second: str | None, events: list[Event], success: bool) -> bool:
    """Whether what happened violates a property of two skills."""
    skills: dict[int, str] = {}
    parents: dict[int, tuple[int, str]] = {}
    going_on: set[int] = set()
    done = owed = False
    for event in events:
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind):
                parents[node] = (parent, kind)
            case ImplementationChosen(node=node, skill=skill):
                skills[node] = skill
                if skill == first and (pattern == "never" or (pattern == "outside" and not going_on)):
                    return True
                if skill == second and pattern == "before" and not done:
                    return True
                going_on |= {node} if skill == second else set()
            case NodeEnded(node=node, status=status):
                skill, good = skills.pop(node, ""), status == "success"
                done |= good and skill == first
                owed = (owed or (good and skill == first)) and not (good and skill == second)
                if node in going_on:
                    going_on.discard(node)
                    going_on |= {scope(node, parents)} if good and skill == "Setup" else set()
                going_on.discard(node)
    return pattern == "eventually" and success and owed


def scope(node: int, parents: dict[int, tuple[int, str]]) -> int:
    """Return the `with` around a node, 0 for the whole run."""
    while node in parents and parents[node][1] != "with":
        node = parents[node][0]
    return node if node in parents else 0
