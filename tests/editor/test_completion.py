"""What is offered fits at the place: exact where the grammar or the ontology decides, in broken files too."""

from __future__ import annotations

import pytest
from lsprotocol import types

from editor.desk import Desk
from editor.texts import MOTION, PRESS, with_line
from skillc_dsl import units
from skillc_dsl.descriptions.members import FLAGS

pytestmark = pytest.mark.asyncio(loop_scope="session")

BEGINNINGS = (
    "class",
    "enum",
    "function",
    "impl",
    "import",
    "prefix",
    "property",
    "relation",
    "skill",
    "task",
    "test",
    "use",
)
DIMENSIONS = " ".join(units.DIMENSIONS)
EXACT = [
    (
        "infer at",
        "    |",
        "cost duration hold in infer opt out outcome pause post pre range senses shares uses "
        + " ".join(each.keyword for each in FLAGS),
    ),
    ("do seq {", "        par |", "all any lead race"),
    ("do seq {", "        Move(arm, |", "target: speed:"),
    ("do seq {", "        Move(speed: 1 m/s, |", "arm arm: target:"),
    ("do seq {", "        Move[|", "line"),
    ("do seq {", "        apply |", "done"),
    ("do seq {", "        timeout 3 |", "s ms min h"),
    ("do seq {", "        Move(arm, speed: 3 |", "m/s cm/s mm/s"),
    ("do seq {", "        Move(arm, speed: 3 m|", "m/s cm/s mm/s"),
    (
        "impl slowly",
        "    refine arm: |",
        "CompliantArm Iiwa14 PositionControlledArm TorqueControlledArm VelocityControlledArm Ur5e Panda Fr3",
    ),
    ("impl slowly", "    refine push: |", "Force"),
    ("impl slowly", "    refine |", "arm: at: panel: push:"),
    ("infer at", "    pre arm.deviceState == |", "Busy Fault Idle"),
    ("infer at", "    pre given |", "push"),
    ("infer at", "    pre panel fixedTo |", "at"),
    ("infer at", "    opt  far: Length = 3 |", "m cm mm"),
    ("infer at", "    uses |", "panel arm push at"),
    ("infer at", "    pause |", "anywhere between never"),
    ("infer at", "    pause between |", "steps"),
    ("infer at", "    pause anywhere |", "keep"),
    ("infer at", "    pause anywhere keep 2 |", "s ms min h"),
    ("class Panel", "relation on(Panel, Location) |", "functional inverse symmetric transitive sub"),
    ("infer at", "    in x: Vector of |", DIMENSIONS),
    ("class Panel", "property wind(Panel): Vector of |", DIMENSIONS),
    ("class Panel", "function f(x: [Vector of |", DIMENSIONS),
    ("class Panel", "skill |", ""),
    ("class Panel", "# any |", ""),
]
AMONG = [
    ("infer at", "    pre arm |", "hasA hasGripper at", "fixedTo target deviceState duration"),
    ("infer at", "    pre panel |", "fixedTo", "hasGripper pre"),
    ("class Panel", "relation isAt(x: Panel, y: Location) = x |", "fixedTo", "hasGripper pre"),
    ("infer at", "    post forall p: Panel (p.isClean == true |", "when and or", "pre"),
    ("infer at", "    post forall p: Panel (p.isClean == true when p.|", "isClean wear", "when pre"),
    ("class Panel", "relation isAt(x: Panel, y: Location) = |", "x y exists not", "pre"),
    ("infer at", "    pre arm.|", "deviceState pose", "isClean wear normal"),
    ("infer at", "    pre panel.is|", "isClean wear normal", "deviceState"),
    ("infer at", "    pre |", "panel arm not exists forall", "pre Move"),
    ("infer at", "    in x: |", "Panel Force Pose Location", "Move Press"),
    ("infer at", "    in x: Pan|", "Panel", "Move"),
    ("infer at", "    in x: |", "Vector Direction", "of"),
    ("infer at", "    in x: Vector |", "of", "Length"),
    ("infer at", "    in x: Panel |", "range", "of"),
    ("class Panel", "function f(x: [|", "Vector Direction Panel", "of"),
    ("do seq {", "        with Compliance(arm, along: |", "panel.normal", "above"),
    ("infer at", "    pre panel is |", "Panel Location", "Force"),
    ("infer at", "    pre panel fixedTo at |", "and or implies", "pre duration"),
    ("do seq {", "        with |", "Compliance Push", "Move Align seq"),
    ("do seq {", "        |", "Move Press Compliance seq sel par with apply", "pre in skill"),
    ("do seq {", "        Move(arm, target: |", "above lifted panel.pose", "push true panel.isClean"),
    ("do seq {", "        Push(arm, along: panel.normal, force: |", "push", "above true panel.wear"),
    ("do seq {", "        Move(arm, target: lifted(|", "above panel.pose", "push"),
    ("do seq {", "        if panel.isClean == |", "true false", "above"),
    ("class Panel", "class Box < |", "Panel Location", "Force fixedTo"),
    ("class Panel", "relation on(|", "Panel", "Force"),
    ("class Panel", "property size(Panel): |", "Length Bool Number", ""),
    ("class Panel", "impl other of |", "Press Move", "Panel"),
    ("use skiros", "use |", "cora rparts", "Panel"),
    ("use skiros", 'import "|', "motion.skill gripper.skill wiping/wipe.skill", "press.skill"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("after", "line", "offered"), EXACT, ids=[line.strip() for _, line, _ in EXACT])
async def test_just_what_fits_is_offered(desk: Desk, after: str, line: str, offered: str) -> None:
    desk.library(motion=MOTION)
    desk.project()
    assert sorted(await desk.completions("press.skill", with_line(PRESS, after, line))) == sorted(offered.split())


@pytest.mark.parametrize(("after", "line", "offered", "absent"), AMONG, ids=[line.strip() for _, line, _, _ in AMONG])
async def test_what_fits_is_among_the_offers(desk: Desk, after: str, line: str, offered: str, absent: str) -> None:
    desk.library(motion=MOTION)
    desk.project()
    found = set(await desk.completions("press.skill", with_line(PRESS, after, line)))
    assert set(offered.split()) <= found
    assert not found & set(absent.split())


async def test_an_empty_file_begins_with_declarations(desk: Desk) -> None:
    offered = await desk.completions("empty.skill", "|")
    assert sorted(offered) == [*BEGINNINGS]


async def test_a_task_is_offered_the_individuals_of_its_scene(desk: Desk) -> None:
    head = "use wiping\nprefix lab: <http://example.org/lab#>\n\n"
    task = 'task clean {\n    scene "ur5e_whiteboard.ttl"\n    goal  |\n}\n'
    offered = await desk.completions("tasks.skill", head + task)
    assert "lab:Whiteboard-1" in offered
    assert "isClean" in await desk.completions("tasks.skill", head + task.replace("|", "lab:Whiteboard-1.|"))
    scenes = await desk.completions("tasks.skill", head + 'task clean {\n    scene "|"\n}\n')
    assert {"ur5e_whiteboard.ttl", "iiwa_table.ttl"} <= set(scenes)


async def test_an_offer_replaces_the_word_and_tells_what_it_is(desk: Desk) -> None:
    desk.library(motion=MOTION)
    text = with_line(PRESS, "infer at", "    pre panel.isC|")
    found = await desk.client.text_document_completion_async(types.CompletionParams(*desk.at("press.skill", text)))
    assert isinstance(found, types.CompletionList)
    item = next(item for item in found.items if item.label == "isClean")
    assert item.detail == "Bool"
    assert item.kind == types.CompletionItemKind.Property
    assert isinstance(item.text_edit, types.TextEdit)
    assert item.text_edit.new_text == "isClean"
    assert item.text_edit.range.end.character - item.text_edit.range.start.character == len("isC")


@pytest.mark.parametrize("broken", ["    pre   fixed: panel", "    pre (", "    in x:", "    }", '    pre "'])
async def test_a_fault_above_does_not_hide_what_fits(desk: Desk, broken: str) -> None:
    desk.library(motion=MOTION)
    text = with_line(with_line(PRESS, "post  done", "    pre panel.|"), "infer at", broken)
    assert "isClean" in await desk.completions("press.skill", text)


HIDDEN = [
    ("do seq {", "        Insp|", "Inspect", 'import "inspection.skill"\n', (3, 0)),
    ("do seq {", "        Wip|", "Wipe", 'import "wiping/wipe.skill"\n', (3, 0)),
    ("infer at", "    in x: Arm|", "ArmDevice", ", rparts", (0, 26)),
    ("infer at", "    in x: Hol|", "PanelHolder", 'import "things.skill"\n', (3, 0)),
    ("infer at", "    pre panel hel|", "heldBy", 'import "things.skill"\n', (3, 0)),
    ("infer at", "    pre panel.siz|", "size", 'import "things.skill"\n', (3, 0)),
    ("do seq {", "        Move(arm, target: pl|", "place_pose", 'import "handling.skill"\n', (3, 0)),
]
THINGS = """use skiros, wiping
class PanelHolder < Location
relation heldBy(WipeableSurface, PanelHolder)
property size(WipeableSurface): Length
"""


@pytest.mark.parametrize(("after", "line", "label", "text", "at"), HIDDEN, ids=[label for _, _, label, _, _ in HIDDEN])
async def test_what_a_file_does_not_see_brings_the_line_that_shows_it(
    desk: Desk, after: str, line: str, label: str, text: str, at: tuple[int, int]
) -> None:
    desk.library(motion=MOTION, things=THINGS)
    written = with_line(PRESS, after, line)
    found = await desk.client.text_document_completion_async(types.CompletionParams(*desk.at("press.skill", written)))
    assert isinstance(found, types.CompletionList)
    (item,) = [each for each in found.items if each.label == label]
    (edit,) = item.additional_text_edits or ()
    assert edit.new_text == text
    assert edit.range == types.Range(types.Position(*at), types.Position(*at))
    seen = [each for each in found.items if each.label in ("Move", "Panel", "fixedTo", "isClean", "above")]
    assert seen and not any(each.additional_text_edits for each in seen)


async def test_a_term_is_qualified_where_its_vocabulary_would_make_names_ambiguous(desk: Desk) -> None:
    text = "use skiros\nclass ArmDevice < Product\nskill Go {\n    in arm: ArmDevice\n    in x: |\n}\n"
    document, position = desk.at("own.skill", text)
    found = await desk.client.text_document_completion_async(types.CompletionParams(document, position))
    assert isinstance(found, types.CompletionList)
    (item,) = [each for each in found.items if each.label.endswith("GripperEffector")]
    assert item.label == "rparts:GripperEffector" and not item.additional_text_edits
