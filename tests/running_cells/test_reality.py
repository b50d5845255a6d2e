"""A simulated cell goes on where it was when its process died: what was held is held, what was done is done."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Generator, Sequence
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from msgspec import structs

from running_cells.test_operations import run_all
from skillc.cells import cell_backend as keeping
from skillc.cells.database import DatabaseError
from skillc.cells.host import CellHost
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.contract.operation import OperationRequest
from skillc.services.library.files import SHIPPED
from skillc.services.project.backends import BackendName
from skillc.services.reporting.reporter import SilentReporter
from skillc_ontology import catalogue
from skillc_runtime.backends.simulation.cell import ModelledCell
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.terms import AT, BASE_FRAME_ID

SORTING = "sorting", "sort_parts", str(SHIPPED / "sorting" / "panda.ttl")
TABLE = "wiping", "clean_table", str(catalogue.scene_path("iiwa_table"))
BOARD = "wiping", "clean_whiteboard", str(catalogue.scene_path("ur5e_whiteboard"))
ONE_PART = OperationRequest(goal="lab:Box-A contain lab:Part-A")
"""Half of what there is to sort."""
PEG = "contact", "insert_peg", str(catalogue.scene_path("panda_peg"))


def find_task(case: tuple[str, str, str]) -> OperationRequest:
    """Return an operation that is the whole task of a case."""
    return OperationRequest(task=case[1])


def make_settings(folder: Path, case: tuple[str, str, str], backend: BackendName) -> CellSettings:
    library, _, scene = case
    return CellSettings(
        name="cell", scene=scene, library=library, folder=str(folder / "state"), backend=backend, seed=3
    )


def reality(host: CellHost) -> ModelledCell:  # type: ignore[type-arg]
    assert isinstance(host.loop.backend, ModelledCell)
    return host.loop.backend


def find_places(host: CellHost) -> dict[str, Array]:
    """Return where things really are (3,), in m, and the postures (nv,) of the arms in rad."""
    cell = reality(host)
    things = {each.individual: cell.ground_truth.body_pose(each.individual).position for each in cell.scene.graspable}
    return things | {name: each.state().q.copy() for name, each in cell.arms.items()}


def crash(
    settings: CellSettings, request: OperationRequest, moments: Sequence[int]
) -> Generator[tuple[CellHost, CellHost]]:
    """Yield a cell after some ticks of an operation, and the same again, from a copy of what its disk had then."""
    with open_cell(settings, SilentReporter()) as host:
        host.submit("first", request)
        for ticks in moments:
            while host.loop.ticks < ticks:
                if not host.tick():
                    host.loop.wait(0.1)
            image = Path(settings.folder).with_name(f"image-{ticks}")
            shutil.copytree(settings.folder, image)
            with open_cell(structs.replace(settings, folder=str(image)), SilentReporter()) as again:
                yield host, again


@pytest.mark.parametrize(
    ("case", "request_", "backend", "moments"),
    [
        (SORTING, ONE_PART, "kinematic", (681, 1250)),
        pytest.param(SORTING, find_task(SORTING), "mujoco", (631, 950, 1977), marks=pytest.mark.sim),
        pytest.param(TABLE, find_task(TABLE), "mujoco", (1050, 3958, 3977), marks=pytest.mark.sim),
        pytest.param(PEG, find_task(PEG), "mujoco", (775, 2229, 2457), marks=pytest.mark.sim),
    ],
)
def test_what_was_interrupted_at_any_moment_is_continued_from_there(
    case: tuple[str, str, str],
    request_: OperationRequest,
    backend: BackendName,
    moments: tuple[int, ...],
    tmp_path: Path,
) -> None:
    with closing(crash(make_settings(tmp_path, case, backend), request_, moments)) as crashes:
        for ticks, (before, again) in zip(moments, crashes, strict=True):
            held = [hand.carries for hand in reality(before)._grippers.values()]
            assert [hand.carries for hand in reality(again)._grippers.values()] == held, ticks
            again.submit("again", OperationRequest(continues="first"))
            (ended,) = run_all(again)
            assert ended.state == "succeeded", (ticks, ended.reason)
            cell = reality(again)
            truth = {each: hand.carries for each, hand in cell._grippers.items()}
            assert {each: hand.holding for each, hand in cell._grippers.items()} == truth
            assert all(each.wiped_share > 0.99 for each in cell.coverage.values())


@pytest.mark.parametrize("ticks", [700, 1250])
def test_a_cell_that_dies_in_the_air_is_there_again_and_at_rest(
    ticks: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # No cell is paced here: what a second of the wall may forget would be many seconds of the arm.
    monkeypatch.setattr(keeping, "PERIOD_S", 0.0)
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with closing(crash(settings, find_task(SORTING), (ticks,))) as crashes:
        before, again = next(crashes)
        where, later = find_places(before), find_places(again)
        assert max(float(np.abs(where[each] - later[each]).max()) for each in where) < 0.05, "as of the last tick"
        assert reality(again).is_at_rest()
        for _ in range(50):
            again.loop.backend.advance(0.01)
        assert all(np.allclose(find_places(again)[each], later[each], atol=1e-6) for each in later)


def test_a_cell_that_was_closed_is_exactly_where_it_was(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        host.submit("first", OperationRequest(task=SORTING[1]))
        for _ in range(700):
            if not host.tick():
                host.loop.wait(0.1)
        host.stop("first", "enough")
        run_all(host)
        where = find_places(host)
    with open_cell(settings, SilentReporter()) as again:
        assert all(np.allclose(find_places(again)[each], where[each], atol=1e-9) for each in where)


def test_a_simulation_that_cannot_be_read_is_refused_with_a_sentence(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        host.tick()
    with closing(sqlite3.connect(settings.journal, isolation_level=None)) as database:
        database.execute("UPDATE cell_state SET value = x'00' WHERE name = 'reality'")
    with (
        pytest.raises(DatabaseError, match=r"journal\.sqlite has a simulation that cannot be read .*restore a backup"),
        open_cell(settings, SilentReporter()),
    ):
        pass


@pytest.mark.parametrize("former", [1, 2, 3])
def test_a_journal_of_a_former_format_is_migrated_and_a_copy_kept(tmp_path: Path, former: int) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        host.tick()
    with closing(sqlite3.connect(settings.journal, isolation_level=None)) as database:
        database.execute("DROP TABLE checkpoints")
        if former < 3:
            database.execute("DROP INDEX unfinished_operations")
        if former == 1:
            database.execute("DROP TABLE cell_state")
            database.execute("ALTER TABLE transactions DROP COLUMN written_ns")
        database.execute(f"PRAGMA user_version = {former}")
    with open_cell(settings, SilentReporter()) as host:
        assert host.describe().state == "operational"
        with closing(sqlite3.connect(settings.journal)) as database:
            query = "EXPLAIN QUERY PLAN SELECT id FROM operations WHERE ended IS NULL ORDER BY submitted_ns, id"
            assert "unfinished_operations" in database.execute(query).fetchone()[-1]
    assert settings.journal.with_name(f"journal.sqlite.format-{former}").exists()


def drive_away(host: CellHost) -> None:
    """Start the task, and run it until its base is on the way."""
    host.submit("first", OperationRequest(task=BOARD[1]))
    (base,) = reality(host)._bases.values()
    while base.at_rest:
        if not host.tick():
            host.loop.wait(0.1)
    for _ in range(150):
        host.tick()
    assert not base.at_rest


def finish(host: CellHost, request: OperationRequest) -> None:
    """Carry out an operation, which succeeds; its base drives on from where it stands."""
    host.submit("again", request)
    (ended,) = run_all(host)
    assert ended.state == "succeeded", ended.reason
    state = host.world.snapshot()
    robot = state.vocabulary.expand("lab:Heron-1")
    assert state.objects(robot, AT) and state.value(robot, BASE_FRAME_ID) is None


@pytest.mark.sim
def test_a_base_that_was_stopped_on_its_way_drives_on(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, BOARD, "kinematic"), SilentReporter()) as host:
        drive_away(host)
        host.stop("first", "enough")
        run_all(host)
        (base,), state = reality(host)._bases.values(), host.world.snapshot()
        robot = state.vocabulary.expand("lab:Heron-1")
        assert not state.objects(robot, AT) and np.allclose(pose(state, robot).position, base.pose.position)
        finish(host, OperationRequest(task=BOARD[1]))


@pytest.mark.sim
def test_a_base_whose_cell_died_on_its_way_drives_on(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, BOARD, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        drive_away(host)
        shutil.copytree(settings.folder, tmp_path / "image")
    with open_cell(structs.replace(settings, folder=str(tmp_path / "image")), SilentReporter()) as again:
        finish(again, OperationRequest(continues="first"))
