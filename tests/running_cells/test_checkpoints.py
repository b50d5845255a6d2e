"""A simulated cell is reset to its scene, saved and restored: the world, its evidence, and reality."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from msgspec import structs

from running_cells.test_continuing import crashed
from running_cells.test_operations import run_all
from running_cells.test_reality import ONE_PART, SORTING, find_places, make_settings
from running_cells.yard import write_yard
from skillc.cells.host import CellHost
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.contract.messages import CheckpointCommand, Edit, Forget, Reset, Restore, Save
from skillc.contract.operation import OperationRequest
from skillc.errors import RequestError
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.difference import changes_between
from skillc_runtime.world.state.world_state import WorldState

CARRY_ALL = OperationRequest(task="carry_all")
RESET = Reset(who="ada", why="again")


@contextmanager
def opened(settings: CellSettings) -> Iterator[CellHost]:
    with open_cell(settings, SilentReporter()) as host:
        host.tick()
        yield host


def done(host: CellHost, name: str, request: OperationRequest) -> int:
    """Carry out an operation to its success; return how many events that had."""
    host.submit(name, request)
    (ended,) = run_all(host)
    assert ended.state == "succeeded", ended
    return ended.events


def refusal(host: CellHost, wanted: CheckpointCommand) -> str:
    with pytest.raises(RequestError) as caught:
        host.checkpoint(wanted)
    return str(caught.value)


def evidence(host: CellHost) -> list[tuple[str | None, str]]:
    return [(each.evidence, each.origin) for each in host.world.ledger.list_undoable() if each.changes]


def assert_same(host: CellHost, world: WorldState, places: dict[str, Array]) -> None:
    assert changes_between(host.world.snapshot(), world) == ()
    now = find_places(host)
    assert now.keys() == places.keys() and now
    for name, each in now.items():
        assert np.allclose(each, places[name], atol=1e-9), name


@pytest.mark.slow
@pytest.mark.parametrize("backend", ["kinematic", pytest.param("mujoco", marks=pytest.mark.sim)])
def test_a_cell_is_reset_to_its_scene_and_the_same_task_is_done_again(backend: str, tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, backend)
    with opened(settings) as host:
        world, places, known = host.world.snapshot(), find_places(host), evidence(host)
        first = done(host, "first", ONE_PART)
        assert done(host, "idle", ONE_PART) < first, "the goal holds already"
        host.checkpoint(RESET)
        assert_same(host, world, places)
        assert evidence(host) == known
        assert host.loop.backend.clock.now == 0.0
        origins = [each.transaction.origin for each in host._reader.latest_writes(2**62, 9)]
        assert "ada: reset to the scene, again" in origins
    with opened(settings) as host:
        assert_same(host, world, places)
        assert evidence(host) == known
        assert done(host, "second", ONE_PART) == first, "the same happens again"


@pytest.mark.slow
def test_what_was_saved_is_restored_also_in_another_process(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with opened(settings) as host:
        done(host, "first", ONE_PART)
        world, places, known = host.world.snapshot(), find_places(host), evidence(host)
        assert any(each == "assumed" or each == "sensed" for each, _ in known)
        host.checkpoint(Save(name="one", who="bo"))
        host.edit(Edit(edits=("not lab:Part-B",), who="bo", why="taken away"))
        host.checkpoint(RESET)
    with opened(settings) as host:
        host.checkpoint(Restore(name="one", who="bo", why=""))
        assert_same(host, world, places)
        assert evidence(host) == known
    with opened(settings) as host:
        assert_same(host, world, places)
        assert evidence(host) == known
        host.checkpoint(Forget(name="one"))
        assert "has no checkpoint one; there are: none" in refusal(host, Restore(name="one", who="bo", why=""))


def test_what_does_not_fit_is_refused_and_changes_nothing(tmp_path: Path) -> None:
    settings = write_yard(tmp_path, 10)
    restore = Restore(name="full", who="bo", why="")
    with opened(settings) as host:
        host.checkpoint(Save(name="full", who="bo"))
        assert "a checkpoint full already" in refusal(host, Save(name="full", who="bo"))
        host.submit("first", CARRY_ALL)
        for wanted in (RESET, restore, Save(name="late", who="bo")):
            assert "first goes on or waits in yard; stop it" in refusal(host, wanted)
        run_all(host)
        world = host.world.snapshot()
        assert "has no checkpoint other; there are: full" in refusal(host, Restore(name="other", who="bo", why=""))
    with opened(structs.replace(settings, seed=9)) as host:
        assert "another seed (0) than the cell has now (9)" in refusal(host, restore)
    library, scene = tmp_path / "yard.skill", tmp_path / "yard.ttl"
    text = library.read_text()
    library.write_text(text.replace("wait 10 ms", "wait 11 ms"))
    with opened(settings) as host:
        assert "another library (" in refusal(host, restore)
    library.write_text(text)
    with opened(settings) as host:
        text = scene.read_text()
        scene.write_text(text + "lab:crate-99 a skiros:Product .\n")
        assert "another scene (yard.ttl " in refusal(host, restore)
        scene.write_text("lab:crate-99 a")
        with pytest.raises(Exception, match=r"yard\.ttl"):
            host.checkpoint(RESET)
        scene.write_text(text)
        assert changes_between(host.world.snapshot(), world) == ()
        host.checkpoint(restore)
        assert done(host, "second", CARRY_ALL) > 10


def test_a_cell_that_cannot_be_built_again_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with opened(write_yard(tmp_path, 10)) as host:
        capabilities = host.loop.backend.capabilities
        monkeypatch.setattr(host.loop.backend, "capabilities", structs.replace(capabilities, checkpoints=None))
        assert not host.describe().resettable
        for wanted in (RESET, Save(name="one", who="bo")):
            assert "yard is no simulation" in refusal(host, wanted)


def test_what_was_interrupted_before_a_reset_is_given_up(tmp_path: Path) -> None:
    with crashed(tmp_path, "carry_all", 9) as host:
        host.checkpoint(RESET)
        with pytest.raises(RequestError, match="submit its task again"):
            host.submit("second", OperationRequest(continues="first"))
