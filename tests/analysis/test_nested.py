"""Nodes and skills that follow their parts several times, nested as deep as may be, are proved in linear time."""

import pytest

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.pipeline import compile
from skillc_dsl.parsing.nesting import DEEPEST
from skillc_dsl.source import Source

LIBRARY = """\
use wiping
skill Clean {{
    in   board: Whiteboard
    post board.isClean == true
}}
impl whole of Clean {{ do {body} }}
skill Wipe {{
    in   board: Whiteboard
    post board.isClean == true
}}
impl plain of Wipe {{ run python "skillc.primitives:StandIn" }}
"""
LEVELS = 20
"""How many skills call one another; with three calls each, there are 3.5 billion ways through them."""
HEADS = ("par all { wait 1 s ", "reactive seq { wait 1 s ", "retry 3 { wait 1 s ", "repeat 9 { ", "once { ")


@pytest.mark.parametrize("head", HEADS)
def test_nested_nodes_are_proved_and_compiled(head: str) -> None:
    body = head * DEEPEST + "Wipe(board)" + " }" * DEEPEST
    outcome = compile([Source("a.skill", LIBRARY.format(body=body))], load_vocabulary(), {}, "own")
    assert [each for each in outcome.diagnostics if each.severity == "error"] == []
    assert make_artifacts(outcome.value)


def test_skills_that_call_one_another_several_times_are_proved_once_each() -> None:
    levels = [
        "skill Level0 { in board: Whiteboard  noplan  uses board }",
        'impl level0 of Level0 { run python "skillc.primitives:StandIn" }',
    ]
    for level in range(1, LEVELS + 1):
        calls = f"Level{level - 1}(board) " * 3
        levels += (f"skill Level{level} {{ in board: Whiteboard  noplan }}",)
        levels += (f"impl level{level} of Level{level} {{ do par all {{ {calls} }} }}",)
    outcome = compile([Source("a.skill", "\n".join(("use wiping", *levels, "")))], load_vocabulary(), {}, "own")
    assert [each for each in outcome.diagnostics if each.severity == "error"] == []
