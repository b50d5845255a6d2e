"""Scenes in the editor: what is wrong with their text as it is typed, and the fixes of it."""

from __future__ import annotations

import pytest
from lsprotocol import types

from editor.desk import Desk

pytestmark = pytest.mark.asyncio(loop_scope="session")

HEAD = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""
RIGHT = f"{HEAD}lab:Shelf-1 a skiros:Product .\n"
WRONG = f"{HEAD}lab:Shelf-1 a skiros:Producct .\n"
TASK = """use skiros
prefix lab: <http://example.org/lab#>

task go {
    scene "cell.ttl"
    goal  lab:Shelf-1 is Product
}
"""


async def actions(desk: Desk) -> list[types.CodeAction]:
    place = types.Range(types.Position(2, 16), types.Position(2, 16))
    document = types.TextDocumentIdentifier(desk.uri("cell.ttl"))
    context = types.CodeActionContext([], only=[types.CodeActionKind.QuickFix])
    found = await desk.client.text_document_code_action_async(types.CodeActionParams(document, place, context))
    return [each for each in found or () if isinstance(each, types.CodeAction)]


async def test_the_text_of_a_scene_in_the_editor_stands_for_the_file(desk: Desk) -> None:
    (desk.folder / "cell.ttl").write_text(RIGHT)
    desk.open("go.skill", TASK)
    assert "unknown-class" not in {each.code for each in await desk.problems("go.skill")}
    desk.open("cell.ttl", WRONG)
    (problem,) = await desk.problems("cell.ttl", ["unknown-class"])
    assert problem.range == types.Range(types.Position(2, 14), types.Position(2, 29))
    desk.type("cell.ttl", RIGHT)
    assert await desk.problems("cell.ttl", []) == []


async def test_the_fix_of_a_scene_is_offered_and_cures_it(desk: Desk) -> None:
    (desk.folder / "cell.ttl").write_text(RIGHT)
    desk.open("go.skill", TASK)
    desk.open("cell.ttl", WRONG)
    await desk.problems("cell.ttl", ["unknown-class"])
    (action,) = await actions(desk)
    assert action.edit is not None and action.edit.changes is not None
    (edit,) = action.edit.changes[desk.uri("cell.ttl")]
    assert (edit.new_text, edit.range.start) == ("skiros:Product", types.Position(2, 14))
    desk.type("cell.ttl", RIGHT)
    assert await desk.problems("cell.ttl", []) == []
    assert await actions(desk) == []


async def test_what_is_asked_of_skills_alone_has_no_answer_for_scenes(desk: Desk) -> None:
    document, position = desk.at("cell.ttl", WRONG)
    assert await desk.client.text_document_hover_async(types.HoverParams(document, position)) is None
    assert await desk.client.text_document_folding_range_async(types.FoldingRangeParams(document)) is None
    assert desk.client.error is None


async def test_an_individual_leads_to_its_scene(desk: Desk) -> None:
    (desk.folder / "cell.ttl").write_text(RIGHT)
    at = desk.at("go.skill", TASK.replace("lab:Shelf-1 is", "lab:Sh|elf-1 is"))
    (place,) = await desk.client.text_document_definition_async(types.DefinitionParams(*at)) or ()
    assert isinstance(place, types.Location)
    assert place.uri == desk.uri("cell.ttl")
    assert (place.range.start, place.range.end) == (types.Position(2, 0), types.Position(2, 11))
