"""Operations of a cell in this process: they wait in a queue, by priority, which has an end."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from functools import partial
from pathlib import Path

import pytest

from running_cells.yard import write_yard
from skillc.cells.host import CellHost
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.contract.messages import Edit
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.services.project.backends import make_backend
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.execution.cell_loop import TooManyRequests
from skillc_runtime.execution.consistency import check_events
from skillc_runtime.execution.planning_queue import PlanningQueue
from skillc_runtime.execution.repeat import repeat_run
from skillc_runtime.recording.commands import EditWorld, Resume
from skillc_runtime.recording.events import PlanMade, Requested, TaskStarted
from skillc_runtime.recording.run_spec import specify
from skillc_runtime.recording.states import ENDS
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

CRATES = [f"lab:crate-{number}" for number in range(4)]


@contextmanager
def opened(folder: Path, takes_ms: int = 10) -> Iterator[CellHost]:
    """Open the cell of a yard in which it takes some time to load a crate, and to unload it."""
    with open_cell(write_yard(folder, takes_ms), SilentReporter()) as host:
        yield host


def run_all(host: CellHost) -> list[OperationStatus]:
    """Tick until no operation goes on; return the ends in their order."""
    ends = list[OperationStatus]()
    while host.loop.runs:
        if not host.tick():
            host.loop.wait(0.01)
        ends += [each for each in host.take_changed() if each.state in ENDS]
    return ends


def test_operations_wait_for_the_cell_by_priority_up_to_a_number(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("skillc.cells.host.MAX_OPERATIONS", 4)
    # One planner at once: with two, the first operation can have its plan, and the cart, before the one that is urgent.
    monkeypatch.setattr("skillc.cells.host.PlanningQueue", partial(PlanningQueue, limit=1))
    with opened(tmp_path) as host:
        for number, priority in enumerate((0, 0, 7, -1)):
            call = f"Load(cart: lab:Cart-1, crate: {CRATES[number]})"
            host.submit(f"op-{number}", OperationRequest(call=call, priority=priority))
        with pytest.raises(TooManyRequests, match="4 operations go on or wait in yard; try again later"):
            host.submit("one more", OperationRequest(task="carry_all"))
        ends = run_all(host)
    assert {each.id: each.state for each in ends} == {
        "op-0": "failed",
        "op-1": "failed",
        "op-2": "succeeded",
        "op-3": "failed",
    }


@pytest.mark.parametrize("ticks", [0, 12])
def test_an_edit_of_a_person_is_an_input_that_can_be_repeated(tmp_path: Path, ticks: int) -> None:
    with opened(tmp_path) as host:
        host.submit("first", OperationRequest(task="carry_all"))
        while ticks and not host.loop.runs[0].tree:
            if not host.tick():
                host.loop.wait(0.01)
        for _ in range(ticks):
            host.tick()
        host.edit(Edit(edits=("lab:Goal skiros:contain lab:crate-5",), who="Ada", why="I carried it"))
        (ended,) = run_all(host)
        assert ended.state == "succeeded"
        with closing(JournalReader(host.settings.journal)) as reader:
            recorded = [each.event for each in reader.envelopes("first")]
        scene = load_scene(Path(host.settings.scene), host.library.vocabulary)
        assert check_events(recorded, host.library, scene) is None
        repeated = repeat_run(recorded, host.library, make_backend("kinematic", WorldModel(scene), 0))
    (edit,) = (each.command for each in recorded if isinstance(each, Requested))
    assert isinstance(edit, EditWorld) and (edit.who, edit.why) == ("Ada", "I carried it")
    assert repeated.difference is None and repeated.ended, str(repeated.difference)


def test_what_is_requested_goes_whole_to_the_engine_and_into_the_journal(tmp_path: Path) -> None:
    request = OperationRequest(task="carry_all", deadline_s=900.0, breakpoints=("Load",), approve=True, owner="Ada")
    with opened(tmp_path) as host:
        host.submit("first", request)
        origin = host.loop.origin
        wanted = specify(request, origin.scene, origin.seed, origin.backend)
        assert host.loop.runs[0].spec == wanted and wanted.breakpoints == ("Load",)
        host.tick()
        with closing(JournalReader(host.settings.journal)) as reader:
            started = reader.envelopes("first", 0)[0].event
    assert isinstance(started, TaskStarted) and started.settings == wanted


def test_each_step_waits_for_a_resume_and_a_repeat_does_too(tmp_path: Path) -> None:
    with opened(tmp_path) as host:
        host.submit("first", OperationRequest(task="carry_all", confirm_steps=True))
        run, confirmed = host.loop.runs[0], list[str]()
        while not run.ended:
            if run.state == "paused":
                confirmed.append(run.reason)
                host.loop.request(run, Resume(who="Ada"))
            if not host.tick():
                host.loop.wait(0.01)
        with closing(JournalReader(host.settings.journal)) as reader:
            recorded = [each.event for each in reader.envelopes("first")]
        scene = load_scene(Path(host.settings.scene), host.library.vocabulary)
        repeated = repeat_run(recorded, host.library, make_backend("kinematic", WorldModel(scene), 0))
    made = next(each for each in recorded if isinstance(each, PlanMade))
    assert sorted(confirmed) == sorted(f"{step.skill} is to be confirmed" for step in made.steps)
    assert repeated.difference is None and repeated.ended, str(repeated.difference)
