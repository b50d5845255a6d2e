"""Tests in the editor: completion, hover, outline and problems, as of tasks."""

from __future__ import annotations

import pytest
from lsprotocol import types

from editor.desk import Desk
from editor.texts import marked

pytestmark = pytest.mark.asyncio(loop_scope="session")
HEAD = "use wiping\nprefix lab: <http://example.org/lab#>\n\n"
TEST = HEAD + (
    "## A board becomes clean.\ntest clean {\n"
    '    scene  "ur5e_whiteboard.ttl"\n'
    "    start  lab:Whiteboard-1.isClean == false\n"
    "    goal   lab:Whiteboard-1.isClean == true\n"
    "    expect lab:Whiteboard-1.isClean == true\n}\n"
)


@pytest.mark.parametrize("member", ["start", "goal", "expect"])
async def test_its_conditions_are_offered_what_its_scene_has(desk: Desk, member: str) -> None:
    text = f'{HEAD}test clean {{\n    scene "ur5e_whiteboard.ttl"\n    {member} |\n}}\n'
    assert "lab:Whiteboard-1" in await desk.completions("tests.skill", text)
    assert "isClean" in await desk.completions("tests.skill", text.replace("|", "lab:Whiteboard-1.|"))


async def test_its_members_are_offered(desk: Desk) -> None:
    offered = await desk.completions("tests.skill", f"{HEAD}test clean {{\n    |\n}}\n")
    assert {"scene", "start", "do", "goal", "expect"} <= set(offered)


async def test_hover_and_outline_tell_that_it_is_one(desk: Desk) -> None:
    document, position = desk.at("tests.skill", marked(TEST, "clean {", 1))
    hover = await desk.client.text_document_hover_async(types.HoverParams(document, position))
    assert hover is not None and isinstance(hover.contents, types.MarkupContent)
    assert "test clean" in hover.contents.value and "A board becomes clean." in hover.contents.value
    known = marked(TEST, "isClean == false", 1)
    at_start = await desk.client.text_document_hover_async(types.HoverParams(*desk.at("tests.skill", known)))
    assert at_start is not None and isinstance(at_start.contents, types.MarkupContent)
    assert "property isClean(" in at_start.contents.value
