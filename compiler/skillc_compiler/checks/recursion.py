"""A skill that calls itself, directly or through others."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("recursion",)
NEEDS = Need.BODY
READS = Reads.NEIGHBOURS
Edges = Mapping[str, Sequence[tuple[str, Call]]]


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each cycle of implementations that call one another, at the call that closes it."""
    edges = {i.key: tuple(_edges(program, i)) for i in program.implementations}
    finished: set[str] = set()
    reported: set[int] = set()
    for start in edges:
        for chain, call in _cycles(edges, start, (), finished):
            if id(call) not in reported:
                reported.add(id(call))
                yield _problem(chain, call)


def _edges(program: Program, implementation: Implementation) -> Iterator[tuple[str, Call]]:
    if not isinstance(implementation.body, TypedNode):
        return
    for node in nodes_in(implementation.body):
        if node.call and node.call.skill:
            yield from ((called.key, node.call) for called in program.candidates(node.call))


def _cycles(
    edges: Edges, here: str, chain: tuple[str, ...], finished: set[str]
) -> Iterator[tuple[tuple[str, ...], Call]]:
    for called, call in edges[here]:
        if called in (*chain, here):
            yield (*chain, here)[(*chain, here).index(called) :], call
        elif called not in finished:
            yield from _cycles(edges, called, (*chain, here), finished)
    finished.add(here)


def _problem(chain: Sequence[str], call: Call) -> Diagnostic:
    skills = [key.partition(".")[0] for key in chain]
    way = " calls ".join(f"`{name}`" for name in (*skills, skills[0]))
    return Diagnostic(
        "recursion",
        call.written.skill.span,
        f"this never ends: {way}",
        help="call another skill, or select an implementation that does not call this one: `Skill[name](..)`",
    )
