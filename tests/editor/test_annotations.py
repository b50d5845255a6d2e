"""What is shown beside a text: hints in its lines, and commands above its declarations that can be carried out."""

from __future__ import annotations

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException

from editor.desk import Desk
from editor.texts import MOTION, PRESS
from skillc.services.tasks.listing import split_reference

pytestmark = pytest.mark.asyncio(loop_scope="session")

GRAB = """use rparts, skiros, skillc
prefix lab: <http://example.org/lab#>

skill Grab {
    in    hand:   GripperEffector
    in    object: Product
    infer from:   Location
    pre   there:  from contain object
    pre   empty:  not hand contain _
    post  held:   hand contain object
    post  gone:   not from contain object
}

impl gently of Grab {
    prefer 1
    run    python "skillc.primitives:StandIn"
}

impl firmly of Grab {
    run python "skillc.primitives:StandIn"
}

skill Put {
    in   hand:   GripperEffector
    in   object: Product
    in   to:     Location
    pre  hand contain object
    post to contain object
    post not hand contain object
}

impl there of Put {
    run python "skillc.primitives:StandIn"
}

skill Fetch {
    in    hand:   GripperEffector
    in    object: Product
    infer from:   Location
    pre   from contain object
    pre   not hand contain _
    post  hand contain object
    post  not from contain object
    noplan
}

impl straight of Fetch {
    let high  = 5 cm
    let times = [1 s, 2 s]
    do  seq {
        for time in times { wait time }
        Grab[firmly](hand, object)
    }
}

task clean(object: Product) {
    scene "ur5e_whiteboard.ttl"
    goal  not lab:Store contain object
}

task grab {
    scene "ur5e_whiteboard.ttl"
    do    seq {
        Grab(hand: lab:Wsg-1, object: lab:Eraser-1)
        Put(hand: lab:Wsg-1, object: lab:Eraser-1, to: lab:Dock)
        Grab(hand: lab:Wsg-1, object: lab:Eraser-1)
    }
}

test grabbed {
    scene  "ur5e_whiteboard.ttl"
    do     Grab(hand: lab:Wsg-1, object: lab:Eraser-1)
    expect lab:Wsg-1 contain lab:Eraser-1
}
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Part-1 a skiros:Product ; skiros:Weight 0.12 ;
    skiros:FrameId "7" .
"""


async def shown(desk: Desk, name: str, text: str) -> str:
    """Return a text with its hints, each in quotation marks."""
    lines = text.split("\n")
    whole = types.Range(types.Position(0, 0), types.Position(len(lines), 0))
    params = types.InlayHintParams(types.TextDocumentIdentifier(desk.uri(name)), whole)
    found = await desk.client.text_document_inlay_hint_async(params)
    for each in sorted(found or (), key=lambda hint: hint.position, reverse=True):
        line, column = each.position.line, each.position.character
        lines[line] = f"{lines[line][:column]}«{each.label}»{lines[line][column:]}"
    return "\n".join(lines)


async def test_types_and_inferred_parameters_are_shown(desk: Desk) -> None:
    desk.project()
    desk.open("grab.skill", GRAB)
    text = await shown(desk, "grab.skill", GRAB)
    assert "let high«: Length in m»  =" in text
    assert "let times«: [Time]» =" in text
    assert "for time«: Time in s» in times" in text
    assert "Grab[firmly](hand, object«, from: ..»)" in text


async def test_what_a_scene_decides_is_shown_in_its_tasks(desk: Desk) -> None:
    desk.project()
    desk.open("grab.skill", GRAB)
    assert await desk.problems("grab.skill") is not None
    text = await shown(desk, "grab.skill", GRAB)
    assert "Grab«[gently]»(hand: lab:Wsg-1, object: lab:Eraser-1«, from: lab:Store»)" in text
    assert "Grab«[gently]»(hand: lab:Wsg-1, object: lab:Eraser-1«, from: lab:Dock»)" in text, "it was put there"


async def test_numbers_of_a_scene_have_their_units(desk: Desk) -> None:
    desk.open("cell.ttl", SCENE)
    assert await shown(desk, "cell.ttl", SCENE) == SCENE.replace("0.12", "0.12« kg»")


async def test_lenses_start_what_is_declared_and_count_its_references(desk: Desk) -> None:
    desk.project()
    desk.library(grab=GRAB)
    desk.open("grab.skill", GRAB)
    params = types.CodeLensParams(types.TextDocumentIdentifier(desk.uri("grab.skill")))
    lines, found = GRAB.split("\n"), await desk.client.text_document_code_lens_async(params)
    commands = [(lines[each.range.start.line], each.command) for each in found or () if each.command]
    assert [(line.split()[1].partition("(")[0], command.title) for line, command in commands] == [
        *(("Grab", "6 references"), ("Put", "2 references"), ("Fetch", "1 reference")),
        *(("clean", "run"), ("clean", "plan"), ("grab", "run"), ("grabbed", "test")),
    ]
    (plan,) = [command.arguments or () for _, command in commands if command.command == "skillc.plan"]
    assert plan[0]["parameters"] == ["object"]
    library, name = split_reference(plan[0]["arguments"][1])
    assert (plan[0]["arguments"][0], library.root, name) == ("plan", desk.folder, "clean")
    (references,) = [command.arguments or () for _, command in commands if command.title == "1 reference"]
    assert references[0] == desk.uri("grab.skill") and len(references[2]) == 1


async def test_references_in_other_files_are_counted(desk: Desk) -> None:
    desk.library(motion=MOTION, press=PRESS)
    desk.open("motion.skill", MOTION)
    params = types.CodeLensParams(types.TextDocumentIdentifier(desk.uri("motion.skill")))
    found = await desk.client.text_document_code_lens_async(params)
    assert [each.command.title for each in found or () if each.command] == ["2 references"]


@pytest.mark.parametrize(
    ("written", "instead", "passed", "said"),
    [
        ("", "", True, "s in its cell"),
        ("expect lab:Wsg-1 contain", "expect not lab:Wsg-1 contain", False, "line 73: "),
        ("pre   there:", "pre   there", None, "the library has errors; the first is in line "),
        ("test grabbed", "test taken", None, "there is no test `grabbed`"),
    ],
)
async def test_a_test_is_run_as_its_text_is_now(
    desk: Desk, written: str, instead: str, passed: bool | None, said: str
) -> None:
    desk.project()
    desk.library(grab=GRAB)
    desk.open("grab.skill", GRAB.replace(written, instead) if written else GRAB)
    asked = {"textDocument": {"uri": desk.uri("grab.skill")}, "name": "grabbed"}
    try:
        answer = await desk.client.protocol.send_request_async("skillc/runTest", asked)
    except JsonRpcException as refused:
        assert passed is None and said in str(refused)
    else:
        assert answer.passed is passed and said in answer.said
