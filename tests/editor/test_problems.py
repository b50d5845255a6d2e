"""Problems are told while somebody types, and taken back when they are gone, of every file of the library."""

from __future__ import annotations

import pytest
from lsprotocol import types

from editor.desk import Desk
from editor.texts import MOTION, PRESS, replaced

pytestmark = pytest.mark.asyncio(loop_scope="session")

FAST = replaced(PRESS, "Move(arm, target: above)", "Move(arm, target: above, speed: 0.2 m/s)")
WRONG = replaced(FAST, "speed", "sped")


async def test_a_good_library_has_no_problems(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    assert await desk.problems("press.skill") == []
    assert await desk.problems("motion.skill") == []


async def test_a_problem_tells_place_name_help_and_cause(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", WRONG)
    (problem,) = await desk.problems("press.skill", ["unknown-argument"])
    line = WRONG[: WRONG.index("sped")].count("\n")
    assert problem.range == types.Range(types.Position(line, 33), types.Position(line, 37))
    assert problem.severity == types.DiagnosticSeverity.Error
    assert problem.message == "the skill `Move` has no parameter `sped`\nhelp: did you mean `speed`?"
    assert problem.related_information is not None
    assert problem.related_information[0].location.uri == desk.uri("motion.skill")


async def test_problems_come_and_go_while_somebody_types(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    assert await desk.problems("press.skill") == []
    desk.type("press.skill", WRONG)
    assert await desk.problems("press.skill", ["unknown-argument"])
    desk.type("press.skill", PRESS)
    assert await desk.problems("press.skill", []) == []


async def test_the_last_of_many_quick_edits_counts(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    for end in range(len(PRESS) - 120, len(PRESS)):
        desk.type("press.skill", PRESS[:end])
    desk.type("press.skill", WRONG)
    assert await desk.problems("press.skill", ["unknown-argument"])
    assert desk.client.error is None


async def test_a_text_in_the_editor_stands_for_the_file(desk: Desk) -> None:
    desk.library(motion=MOTION, press=FAST)
    desk.open("press.skill", FAST)
    desk.open("motion.skill", replaced(MOTION, "opt  speed:", "opt  pace:"))
    problems = await desk.problems("press.skill", ["unknown-argument"])
    assert "`speed`" in problems[0].message
    desk.close("motion.skill")
    assert await desk.problems("press.skill", []) == []


async def test_a_deleted_file_is_missed(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    assert await desk.problems("press.skill") == []
    assert types.WORKSPACE_DID_CHANGE_WATCHED_FILES in desk.client.registered
    (desk.folder / "motion.skill").unlink()
    event = types.FileEvent(desk.uri("motion.skill"), types.FileChangeType.Deleted)
    desk.client.workspace_did_change_watched_files(types.DidChangeWatchedFilesParams([event]))
    # The shipped file of that name is found instead, which has no skill `Move`.
    problems = await desk.problems("press.skill", ["unknown-skill"])
    assert "`Move`" in problems[0].message


async def test_problems_of_a_file_that_is_closed_for_good_are_taken_back(desk: Desk) -> None:
    desk.open("only.skill", "skill Only {")
    assert await desk.problems("only.skill", ["unclosed-brace"])
    desk.close("only.skill")
    assert await desk.problems("only.skill", []) == []


async def test_two_libraries_do_not_mix(desk: Desk) -> None:
    for name in ("one", "two"):
        (desk.folder / name).mkdir()
        (desk.folder / name / "motion.skill").write_text(MOTION)
    desk.open("one/press.skill", PRESS)
    desk.open("two/press.skill", WRONG)
    assert await desk.problems("two/press.skill", ["unknown-argument"])
    assert await desk.problems("one/press.skill", []) == []


async def test_a_file_outside_of_every_folder_is_a_library_with_its_neighbours(
    desk: Desk, tmp_path_factory: pytest.TempPathFactory
) -> None:
    (desk.folder / "motion.skill").write_text(MOTION)
    folder = desk.folder.parent.parent / f"{desk.folder.parent.name}_outside"
    folder.mkdir()
    (folder / "below").mkdir()
    (folder / "below" / "broken.skill").write_text("skill")
    (folder / "motion.skill").write_text(MOTION)
    outside = Desk(desk.client, folder)
    outside.open("press.skill", WRONG)
    assert await outside.problems("press.skill", ["unknown-argument"])
    assert outside.uri("below/broken.skill") not in desk.client.diagnostics


async def test_a_text_that_is_no_file_yet_is_checked(desk: Desk) -> None:
    item = types.TextDocumentItem("untitled:Untitled-1", "skill", 1, "skill Wipe {")
    desk.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
    while "untitled:Untitled-1" not in desk.client.diagnostics:
        await desk.client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    assert desk.client.diagnostics["untitled:Untitled-1"]
    document = types.TextDocumentIdentifier("untitled:Untitled-1")
    desk.client.text_document_did_close(types.DidCloseTextDocumentParams(document))


async def test_a_scene_is_checked_with_its_task(desk: Desk) -> None:
    desk.library(motion=MOTION)
    scene = "@prefix lab: <http://example.org/lab#> .\n@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .\n"
    (desk.folder / "cell.ttl").write_text(f"{scene}lab:Shelf-1 a skiros:Lokation .\n")
    task = (
        'prefix lab: <http://example.org/lab#>\ntask go {\n    scene "cell.ttl"\n    goal  lab:Shelf-1 is Location\n}\n'
    )
    desk.open("press.skill", f"{PRESS}\n{task}")
    assert await desk.problems("cell.ttl")
