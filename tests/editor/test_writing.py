"""Renaming, fixes and formatting: the edits an editor applies give the text that was meant."""

from __future__ import annotations

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException

from editor.desk import Desk
from editor.texts import MOTION, PRESS, marked, replaced

pytestmark = pytest.mark.asyncio(loop_scope="session")

GO = MOTION.replace("skill Move {", "skill Go {").replace("of Move", "of Go")
RENAMES = [
    ("Panel <", "Board", {"press.skill": PRESS.replace("Panel", "Board")}),
    ("fixedTo(", "mountedOn", {"press.skill": PRESS.replace("fixedTo", "mountedOn")}),
    ("lifted(pose", "raise_", {"press.skill": PRESS.replace("lifted", "raise_")}),
    ("slowly", "gently", {"press.skill": PRESS.replace("slowly", "gently")}),
    ("above", "over", {"press.skill": PRESS.replace("above", "over")}),
    ("done:", "clean", {"press.skill": PRESS.replace("done", "clean")}),
    (
        "push:",
        "effort",
        {"press.skill": PRESS.replace("opt   push", "opt   effort").replace("force: push", "force: effort")},
    ),
    (
        "arm:   Comp",
        "robot_arm",
        {
            "press.skill": PRESS.replace("in    arm:", "in    robot_arm:")
            .replace("ready: arm.", "ready: robot_arm.")
            .replace("(arm,", "(arm: robot_arm,")
        },
    ),
    (
        "Move(",
        "Go",
        {
            "press.skill": PRESS.replace("Move(", "Go("),
            "motion.skill": MOTION.replace("skill Move {", "skill Go {").replace("of Move", "of Go"),
        },
    ),
    (
        "target: above",
        "aim",
        {"press.skill": PRESS.replace("target:", "aim:"), "motion.skill": MOTION.replace("target:", "aim:")},
    ),
]
REFUSALS = [
    ("isClean", "shiny", "declared in the ontology"),
    ("Push(", "Shove", "declared in std/compliance.skill, outside of this library"),
    ("5 cm", "six", "nothing here that has a name"),
    ("Press {", "skill", "`skill` is no name"),
    ("Press {", "two words", "`two words` is no name"),
    ("Press {", "Compliance", "`Compliance` would not do"),
    ("push:", "at", "`at` would not do"),
    ("above", "panel", "`panel` would not do"),
]


@pytest.mark.parametrize(("words", "new", "after"), RENAMES, ids=[words for words, _, _ in RENAMES])
async def test_a_thing_is_renamed_everywhere(desk: Desk, words: str, new: str, after: dict[str, str]) -> None:
    desk.library(motion=MOTION)
    document, position = desk.at("press.skill", marked(PRESS, words, 1))
    place = await desk.client.text_document_prepare_rename_async(types.PrepareRenameParams(document, position))
    assert isinstance(place, types.PrepareRenamePlaceholder)
    edit = await renamed(desk, document, position, new)
    before = {"press.skill": PRESS, "motion.skill": MOTION}
    assert edited(desk, edit, before) == {**before, **after}


@pytest.mark.parametrize(("words", "new", "reason"), REFUSALS, ids=[f"{words} {new}" for words, new, _ in REFUSALS])
async def test_what_would_not_do_is_refused_with_its_reason(desk: Desk, words: str, new: str, reason: str) -> None:
    desk.library(motion=MOTION)
    document, position = desk.at("press.skill", marked(PRESS, words, 1))
    with pytest.raises(JsonRpcException, match=reason):
        await renamed(desk, document, position, new)


async def test_renaming_what_a_shorthand_means_spells_it_out(desk: Desk) -> None:
    desk.library(motion=MOTION)
    document, position = desk.at("motion.skill", marked(MOTION, "arm:    ArmDevice"))
    desk.open("press.skill", PRESS)
    edit = await renamed(desk, document, position, "mover")
    after = edited(desk, edit, {"press.skill": PRESS, "motion.skill": MOTION})
    assert after["press.skill"] == PRESS.replace("Move(arm,", "Move(mover: arm,")
    assert after["motion.skill"] == MOTION.replace("in   arm:", "in   mover:").replace("uses arm", "uses mover")


async def test_every_fix_of_a_problem_is_offered(desk: Desk) -> None:
    desk.library(motion=MOTION)
    wrong = replaced(replaced(PRESS, "isClean", "isClaen"), "Move(arm, target: above)", "Move(arm, taget: above)")
    desk.open("press.skill", wrong)
    rows = wrong.split("\n")
    whole = types.Range(types.Position(0, 0), types.Position(len(rows), 0))
    actions = await fixes(desk, "press.skill", whole)
    titles = [action.title for action in actions if action.kind == types.CodeActionKind.QuickFix]
    assert "write `isClean`" in titles
    assert "write `target`" in titles
    assert all(action.diagnostics for action in actions if action.kind == types.CodeActionKind.QuickFix)
    fixed = wrong
    for action in actions:
        if action.kind == types.CodeActionKind.QuickFix and action.title in ("write `isClean`", "write `target`"):
            fixed = edited(desk, action.edit, {"press.skill": fixed})["press.skill"]
    assert fixed == PRESS


async def test_no_fix_is_offered_where_there_is_no_problem(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    start = types.Position(0, 0)
    assert await fixes(desk, "press.skill", types.Range(start, start)) == []


async def test_a_file_is_laid_out(desk: Desk) -> None:
    untidy = replaced(MOTION, "    in   arm:    ArmDevice", "  in arm:     ArmDevice")
    desk.open("motion.skill", untidy)
    assert await laid_out(desk, "motion.skill", untidy) == MOTION
    desk.type("motion.skill", MOTION)
    assert await laid_out(desk, "motion.skill", MOTION) == MOTION


async def test_a_file_with_errors_is_left_as_it_is(desk: Desk) -> None:
    broken = replaced(MOTION, "noplan\n}", "noplan\n")
    desk.open("motion.skill", broken)
    assert await laid_out(desk, "motion.skill", broken) == broken


async def renamed(
    desk: Desk, document: types.TextDocumentIdentifier, position: types.Position, new: str
) -> types.WorkspaceEdit | None:
    """Return the edits that rename what is at a place."""
    params = types.RenameParams(text_document=document, position=position, new_name=new)
    return await desk.client.text_document_rename_async(params)


async def fixes(desk: Desk, name: str, place: types.Range) -> list[types.CodeAction]:
    """Return the code actions for a place."""
    document = types.TextDocumentIdentifier(desk.uri(name))
    params = types.CodeActionParams(document, place, types.CodeActionContext([]))
    found = await desk.client.text_document_code_action_async(params)
    return [action for action in found or () if isinstance(action, types.CodeAction)]


async def laid_out(desk: Desk, name: str, text: str) -> str:
    """Return a text after the edits of the formatter."""
    document = types.TextDocumentIdentifier(desk.uri(name))
    params = types.DocumentFormattingParams(document, types.FormattingOptions(4, insert_spaces=True))
    edits = await desk.client.text_document_formatting_async(params)
    return applied(text, edits or ())


def edited(desk: Desk, edit: types.WorkspaceEdit | None, before: dict[str, str]) -> dict[str, str]:
    """Return texts after the edits of a workspace."""
    assert edit is not None
    assert edit.changes
    changes = {uri.rpartition("/")[2]: edits for uri, edits in edit.changes.items()}
    assert set(changes) <= set(before)
    return {name: applied(text, changes.get(name, ())) for name, text in before.items()}


def applied(text: str, edits: object) -> str:
    """Return an ASCII text after edits."""
    assert isinstance(edits, list | tuple)
    lines = text.split("\n")
    starts = [sum(len(line) + 1 for line in lines[:number]) for number in range(len(lines) + 1)]
    for edit in sorted(edits, key=lambda each: each.range.start, reverse=True):
        start = starts[edit.range.start.line] + edit.range.start.character
        end = starts[edit.range.end.line] + edit.range.end.character
        text = text[:start] + edit.new_text + text[end:]
    return text
