"""The states of a cell: what devices report ends operations, stays over a restart, and is acknowledged by somebody."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from running_cells.test_operations import run_all
from running_cells.test_reality import ONE_PART, SORTING, make_settings, reality
from skillc.cells.host import CellHost
from skillc.cells.opening import open_cell
from skillc.contract.cell import CellState
from skillc.contract.messages import Acknowledge, Edit, Refused, Submit, TakeSnapshot
from skillc.contract.operation import OperationStatus
from skillc.errors import RequestError
from skillc.server.supervisor import CellSupervisor
from skillc.services.replaying.check import check_run
from skillc.services.reporting.reporter import SilentReporter
from skillc_ontology import catalogue
from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.supervision.safety import SafetyLimits
from skillc_runtime.devices.backend import StopPersists
from skillc_runtime.devices.disturbances import Disturbance, LoseArm, MoveThing, PressEmergencyStop, PushArm, TakeThing
from skillc_runtime.world.state.terms import CONTAIN

DOCS = Path(__file__).parents[2] / "docs"
LAB, ARM = "http://example.org/lab#", "lab:Arm-1"
TASK = ONE_PART
PRESS, RELEASE = PressEmergencyStop(), PressEmergencyStop(False)


def run_until(host: CellHost, ticks: int) -> None:
    while host.loop.ticks < ticks:
        if not host.tick():
            host.loop.wait(0.1)


def interrupt(host: CellHost, cause: Callable[[CellHost], None]) -> OperationStatus:
    """Let something happen while an arm moves, and return how the operation has ended."""
    host.submit("first", TASK)
    run_until(host, 300)
    cause(host)
    (ended,) = run_all(host)
    return ended


def disturbed(*disturbances: Disturbance) -> Callable[[CellHost], None]:
    def disturb(host: CellHost) -> None:
        for each in disturbances:
            host.disturb(each, "bo")

    return disturb


def exceed_a_limit(host: CellHost) -> None:
    for driver in reality(host)._drivers.values():
        driver._safety.limits = SafetyLimits(tool_speed_m_s=0.01)


def measure_nonsense(host: CellHost) -> None:
    for arm in reality(host).arms.values():
        arm._dq[:] = np.nan


def measure_again(host: CellHost) -> None:
    for arm in reality(host).arms.values():
        arm._dq[:] = 0.0


def find_state(host: CellHost) -> tuple[str, str]:
    status = host.describe()
    return status.state, status.reason


def acknowledge(host: CellHost) -> str:
    try:
        host.acknowledge()
    except RequestError as refused:
        return str(refused)
    return ""


@pytest.mark.parametrize(
    ("cause", "state", "reason", "refused", "remedy"),
    [
        (disturbed(PRESS), "emergency-stop", "an emergency stop is pressed", "still pressed", disturbed(RELEASE)),
        (
            disturbed(LoseArm(ARM)),
            "protective-stop",
            "it does not answer",
            "does not answer yet",
            disturbed(LoseArm(ARM, False)),
        ),
        (exceed_a_limit, "protective-stop", "beyond the 0.01 m/s that the arm may", "", None),
        (measure_nonsense, "protective-stop", "something that is not a number", "not a number", measure_again),
    ],
)
def test_what_a_device_reports_ends_operations_until_it_is_acknowledged(
    cause: Callable[[CellHost], None],
    state: str,
    reason: str,
    refused: str,
    remedy: Callable[[CellHost], None] | None,
    tmp_path: Path,
) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        ended = interrupt(host, cause)
        assert ended.state == "failed" and reason in ended.reason and state.replace("-", " ") in ended.reason
        assert find_state(host)[0] == state and reason in find_state(host)[1]
        with pytest.raises(RequestError, match=rf"cell takes no operations \({state}\)"):
            host.submit("second", TASK)
        if remedy is not None:
            assert refused in acknowledge(host) != "", "the cause is still there"
            assert find_state(host)[0] == state
            remedy(host)
        assert find_state(host)[0] == state, "nothing goes on by itself"
        for driver in reality(host)._drivers.values():
            driver._safety.limits = SafetyLimits()
        assert acknowledge(host) == "" and find_state(host) == ("operational", "")
        assert "no fault and no stop" in acknowledge(host)
        host.submit("third", TASK)
        (again,) = run_all(host)
        assert again.state == "succeeded", again.reason


def test_a_stop_is_still_there_when_the_cell_is_started_again(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        interrupt(host, disturbed(PRESS))
    with open_cell(settings, SilentReporter()) as host:
        assert find_state(host) == ("emergency-stop", "an emergency stop is pressed")
        assert acknowledge(host) == ""
    with open_cell(settings, SilentReporter()) as host:
        assert find_state(host) == ("operational", "")


def test_an_emergency_stop_hides_a_protective_one_and_not_the_other_way_round(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        for disturbance, state in (
            (LoseArm(ARM), "protective-stop"),
            (PRESS, "emergency-stop"),
            (RELEASE, "emergency-stop"),
        ):
            host.disturb(disturbance, "bo")
            host.obey()
            assert find_state(host)[0] == state
        assert "does not answer yet" in acknowledge(host)
        host.disturb(LoseArm(ARM, False), "bo")
        assert acknowledge(host) == ""


@pytest.mark.parametrize(
    ("disturbance", "refused"),
    [
        (PushArm("lab:Arm-2", (1.0, 0.0, 0.0)), "did you mean"),
        (PushArm("lab:Box-A", (1.0, 0.0, 0.0)), "is no arm with a hand"),
        (LoseArm("lab:Box-A"), "is no arm"),
        (MoveThing("lab:Box-A", (0.1, 0.0, 0.0)), "is nothing that can be moved"),
        (TakeThing("lab:Part-A"), "is in no gripper"),
        (MoveThing("lab:Part-Z", (0.1, 0.0, 0.0)), "did you mean"),
    ],
)
def test_a_disturbance_that_is_not_possible_says_why(disturbance: Disturbance, refused: str, tmp_path: Path) -> None:
    with (
        open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host,
        pytest.raises(RequestError, match=refused),
    ):
        host.disturb(disturbance, "bo")


def test_a_simulation_that_has_diverged_is_not_disturbed(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        reality(host)._broken = "the acceleration of a joint is too large"
        with pytest.raises(RequestError, match="nothing moves any more: the acceleration"):
            host.disturb(MoveThing("lab:Part-A", (0.1, 0.0, 0.0)), "bo")
        assert find_state(host)[0] == "fault" and "start the cell again" in acknowledge(host)


def test_a_thing_that_somebody_moved_is_there_when_the_cell_is_started_again(tmp_path: Path) -> None:
    settings, part = make_settings(tmp_path, SORTING, "kinematic"), "http://example.org/lab#Part-A"
    with open_cell(settings, SilentReporter()) as host:
        before = reality(host).ground_truth.body_pose(part).position
        host.disturb(MoveThing("lab:Part-A", (0.03, -0.01, 0.0)), "bo")
        host.obey()
        after = reality(host).ground_truth.body_pose(part).position
        assert np.allclose(after - before, (0.03, -0.01, 0.0), atol=1e-6)
    with open_cell(settings, SilentReporter()) as host:
        assert np.allclose(reality(host).ground_truth.body_pose(part).position, after, atol=1e-6)


@pytest.mark.parametrize("backend", ["kinematic", pytest.param("mujoco", marks=pytest.mark.sim)])
def test_what_is_taken_out_of_a_hand_is_missed_by_its_fingers_and_withdrawn(backend: str, tmp_path: Path) -> None:
    settings, part, hand = make_settings(tmp_path, SORTING, backend), LAB + "Part-A", LAB + "Hand-1"  # type: ignore[arg-type]
    with open_cell(settings, SilentReporter()) as host:
        host.submit("first", TASK)
        while reality(host).ground_truth.carried_by(hand) != part:
            run_until(host, host.loop.ticks + 1)
        run_until(host, host.loop.ticks + 20)
        with pytest.raises(RequestError, match="it can be taken out of the hand"):
            host.disturb(MoveThing("lab:Part-A", (0.3, 0.0, 0.0)), "bo")
        host.disturb(TakeThing("lab:Part-A", (0.0, -0.3, 0.0)), "bo")
        assert host.world.snapshot().holds(hand, CONTAIN, part), "nobody has felt it yet"
        (ended,) = run_all(host)
        assert ended.state == "failed" and ended.failure is not None
        assert "lost lab:Part-A: its fingers have closed from" in ended.failure.message
        assert not host.world.snapshot().holds(hand, CONTAIN, part)
    checked = check_run(Path(settings.folder) / "recordings" / "first.mcap", None, SilentReporter())
    assert checked.ok, checked


@pytest.mark.parametrize("backend", ["kinematic", pytest.param("mujoco", marks=pytest.mark.sim)])
def test_a_run_that_was_disturbed_is_repeated_with_its_disturbances(backend: str, tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, backend)  # type: ignore[arg-type]
    with open_cell(settings, SilentReporter()) as host:
        host.submit("first", TASK)
        run_until(host, 100)
        host.disturb(PushArm(ARM, (0.0, 20.0, 0.0), 0.3), "bo")
        host.disturb(MoveThing("lab:Part-B", (0.004, 0.003, 0.0)), "bo")
        run_until(host, 600)
        host.disturb(PRESS, "bo")
        (ended,) = run_all(host)
        assert ended.state == "failed"
    checked = check_run(Path(settings.folder) / "recordings" / "first.mcap", None, SilentReporter())
    assert checked.ok and checked.repeated == checked.events, checked


def fill_the_disk(host: CellHost) -> None:
    """Let the journal grow no more, as on a full disk."""
    connection = host._journal._connection
    (pages,) = connection.execute("PRAGMA page_count").fetchone()
    connection.execute(f"PRAGMA max_page_count = {pages}")
    for number in range(200):
        host._journal.set_state(f"filler {number}", bytes(1000))
    host.obey()


def reach(host: CellHost, state: str) -> None:
    """Bring a cell into a state whose cause is gone then."""
    match state:
        case "protective-stop":
            disturbed(LoseArm(ARM), LoseArm(ARM, False))(host)
        case "emergency-stop":
            disturbed(PRESS, RELEASE)(host)
        case "fault":
            fill_the_disk(host)
            host._journal._connection.execute("PRAGMA max_page_count = 1000000")
    assert find_state(host)[0] == state


def test_a_stop_that_cannot_be_forgotten_durably_is_not_acknowledged(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        reach(host, "emergency-stop")
        host.obey()
        fill_the_disk(host)
        assert "full" in acknowledge(host) and find_state(host)[0] == "emergency-stop"
        host._journal._connection.execute("PRAGMA max_page_count = 1000000")
        assert acknowledge(host) == "" and find_state(host) == ("operational", "")


def is_done(request: Callable[[], object]) -> str:
    try:
        request()
    except RequestError:
        return "no"
    return "yes"


def read_table() -> dict[str, list[str]]:
    """Return what the documentation says for each state: submit, edit, ask, acknowledge."""
    page = (DOCS / "server.md").read_text(encoding="utf-8")
    section = page.partition("### States of a cell\n")[2].partition("###")[0]
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in section.splitlines() if line.startswith("| `")]
    return {row[0].strip("`"): row[2:] for row in rows}


def test_the_documentation_has_all_states() -> None:
    assert set(read_table()) == set(get_args(CellState))


@pytest.mark.parametrize("state", [each for each in get_args(CellState) if each != "off"])
def test_each_state_allows_what_the_documentation_says(state: str, tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        reach(host, state)
        edit = partial(host.edit, Edit(edits=("lab:spare a skiros:Product",), who="bo", why="to see"))
        requests = (partial(host.submit, "op", TASK), edit, host.take_snapshot, host.acknowledge)
        assert [is_done(each) for each in requests] == read_table()[state]
        assert find_state(host) == ("operational", "")


def test_a_cell_that_is_off_allows_what_the_documentation_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc.server.supervisor.START_S", 0.01)

    async def ask() -> list[str]:
        cell = CellSupervisor(make_settings(tmp_path, SORTING, "kinematic"), lambda _: None)
        messages = (
            Submit(operation="op", request=TASK),
            Edit(edits=("not lab:Part-A",), who="bo", why="to see"),
            TakeSnapshot(),
            Acknowledge(),
        )
        return ["no" if isinstance(await cell.request(each), Refused) else "yes" for each in messages]

    assert asyncio.run(ask()) == read_table()["off"]


@pytest.mark.sim
def test_a_push_moves_the_hand_and_after_an_emergency_stop_nothing_moves(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "mujoco"), SilentReporter()) as host:
        cell, arm = reality(host), "http://example.org/lab#Arm-1"
        before = cell.arms[arm].state().tool.position.copy()
        host.disturb(PushArm(ARM, (0.0, 30.0, 0.0), 0.3), "bo")
        cell.advance(0.3)
        moved = cell.arms[arm].state().tool.position - before
        assert 0.001 < moved[1] < 0.2, moved
        cell.advance(2.0)
        assert abs((cell.arms[arm].state().tool.position - before)[1]) < 0.5 * moved[1], "the push has ended"
        ended = interrupt(host, disturbed(PRESS))
        assert ended.state == "failed" and cell.is_at_rest()
        where = cell.arms[arm].state().q.copy()
        cell.advance(0.5)
        assert np.allclose(cell.arms[arm].state().q, where, atol=0.01)


def test_a_stop_that_one_arm_still_causes_is_acknowledged_for_none(tmp_path: Path) -> None:
    scene = str(catalogue.scene_path("two_robots"))
    with open_cell(make_settings(tmp_path, ("wiping", "", scene), "kinematic"), SilentReporter()) as host:
        cell = reality(host)
        (first, fast), (second, blind) = cell._drivers.items()
        fast._safety.limits = SafetyLimits(tool_speed_m_s=0.01)
        fast.motion.move_joints(fast.measured.q + 0.2, 1.0)
        cell.advance(0.5)
        stopped = cell.stops.report
        assert stopped is not None and "beyond the 0.01 m/s" in stopped.reason
        cell.arms[second]._dq[:] = np.nan
        with pytest.raises(ControlError):
            cell.advance(0.01)
        with pytest.raises(StopPersists) as persists:
            cell.stops.clear()
        names = {each: host.library.vocabulary.short(each) for each in (first, second)}
        assert names[second] in str(persists.value) and names[first] not in str(persists.value)
        assert cell.stops.report == stopped and blind.broken is not None, "nothing has changed"
        cell.arms[second]._dq[:] = 0.0
        cell.stops.clear()
        assert cell.stops.report is None
