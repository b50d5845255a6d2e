"""What random libraries have shown, written small."""

from __future__ import annotations

from columns.case import Case, vocabulary
from columns.columns import Ended, execute
from columns.worlds import TERMS, Fact, World
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source

STAND_IN = 'run python "skillc.primitives:StandIn"'


def run(text: str, body: str, *facts: Fact) -> Ended:
    """Run a body in a world with a tray and a spot."""
    text = f'{TERMS}{text}\ntask go {{\n    scene "none.ttl"\n    do {body}\n}}\n'
    library = compile_sources([Source("columns.skill", text)], vocabulary(), {}, "columns", {}).value
    node = library.tasks["go"].body
    assert node is not None
    ended = execute(Case([], [], [], [World(("S1", "T1"), frozenset(facts))], text, library), node)
    assert ended is not None
    return ended


def test_what_is_known_of_an_outcome_need_not_be_sensed_again() -> None:
    toss = f"""
skill Toss {{
    in a: Tray
    outcome up:   a.open == true and not a lies _
    outcome down: a.open == false and not a lies _
}}
impl one of Toss {{ {STAND_IN} }}
"""
    ended = run(toss, "Toss(a: lab:T1)", ("at", "T1", "S1"))
    assert ended.ok and ended.world.value("T1", "open") is not None, ended.why
