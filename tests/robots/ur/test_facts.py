"""What is read of an arm and its gripper before anything is connected, and what is said if it is missing."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import pytest
from msgspec.structs import replace

from robots.ur.tasks import ARM, HAND
from skillc.world import load_scene, load_vocabulary
from skillc_ontology import catalogue
from skillc_runtime.backends.devices.gripper_facts import open_gripper
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.backends.ur.cell import UrDescription, open_arms
from skillc_runtime.backends.ur.facts import UrFacts, read_facts
from skillc_runtime.backends.ur.states import read_condition
from skillc_runtime.devices.arm import Mode
from skillc_runtime.devices.backend import BackendUnavailable
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DRIVER_ADDRESS, GRIPPER_PROTOCOL, HAS_SHEET, SKILLC, UR
from skillc_runtime.world.state.world_state import WorldState

THERE = SetProperty(ARM, DRIVER_ADDRESS, "192.168.1.2")


def scene(changes: Sequence[Change]) -> tuple[WorldState, ArmSpec]:
    state = load_scene(catalogue.scene_path("ur5e_button"), load_vocabulary()).with_changes(changes)
    return state, read_scene_spec(state).arms[0]


def facts(*changes: Change) -> UrFacts:
    return read_facts(*scene(changes))


def test_what_the_arm_states_comes_before_its_sheet_and_this_before_defaults() -> None:
    found = facts(THERE, SetProperty(ARM, UR + "servoGain", 500.0))
    assert (found.address, found.name) == ("192.168.1.2", "lab:Ur5e-1 at 192.168.1.2")
    assert (found.servo.gain, found.servo.lookahead_s, found.command_timeout_s) == (500.0, 0.03, 0.1)


@pytest.mark.parametrize("beside", [(), ("position",)])
def test_an_arm_that_takes_joint_torques_is_refused_before_anything_is_connected(beside: tuple[Mode, ...]) -> None:
    state, arm = scene([THERE])
    with pytest.raises(SheetError, match=r"lab:Ur5e-1 is a skillc:TorqueC.*sends no joint torques.*must be a"):
        read_facts(state, replace(arm, modes=("torque", *beside)))


def test_an_arm_with_the_sheet_of_another_one_is_refused_before_anything_is_connected() -> None:
    """Its servos are stated, as on the sheet of an arm of one's own; nobody is at the address."""
    ours, other = SKILLC + "ur5e-sheet", SKILLC + "iiwa14-sheet"
    changes = [RemoveRelation(ARM, HAS_SHEET, ours), AddRelation(ARM, HAS_SHEET, other)]
    servos = [SetProperty(other, SKILLC + name, 1e3) for name in ("servoStiffness", "servoDamping")]
    state, _ = scene([THERE, *changes, *servos, SetProperty(other, SKILLC + "admittance", 0.01)])
    with pytest.raises(
        SheetError, match=r"lab:Ur5e-1 has 7 joints by skillc:iiwa14-sheet, an arm of .* has 6: is that"
    ):
        open_arms(WorldModel(state))


def test_an_arm_without_address_is_refused_with_what_to_write() -> None:
    with pytest.raises(
        SheetError, match=r'write skiros:DriverAddress "192\.168\.1\.2", with its own address, at lab:Ur5'
    ):
        facts()


def test_a_missing_library_is_named_with_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rtde_control", None)
    with pytest.raises(BackendUnavailable, match=r"ur-rtde cannot be imported.*: pip install 'skillc\[ur\]'"):
        UrDescription(facts(THERE)).make_link()


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ([], "where lab:Wsg-1 is on the network is not stated"),
        ([SetProperty(SKILLC + "wsg50-sheet", GRIPPER_PROTOCOL, "telepathy")], "not 'telepathy'"),
        ([SetProperty(HAND, DRIVER_ADDRESS, "127.0.0.96:6310")], r"does not answer at 127\.0\.0\.96, port 6310"),
    ],
)
def test_a_gripper_that_cannot_be_driven_is_refused_with_the_reason(changes: list[Change], says: str) -> None:
    state, arm = scene([THERE, *changes])
    assert arm.gripper is not None
    with pytest.raises((SheetError, BackendUnavailable), match=says):
        open_gripper(state, arm.gripper, "127.0.0.96", lambda *_: None, lambda: None)


@pytest.mark.parametrize(
    ("bits", "robot", "runtime", "controls", "kind", "says"),
    [
        (1, 7, 1, False, "ready", ""),
        (1, 7, 2, True, "in-control", ""),
        (1, 7, 2, False, "not-in-control", "another program"),
        (1, 7, 1, True, "not-in-control", "has ended"),
        (1, 5, 1, False, "wrong-mode", "has its brakes on"),
        (1 << 2 | 1 << 10, 7, 4, True, "protective-stop", "has stopped by itself"),
        (1 << 4 | 1 << 10, 7, 4, True, "protective-stop", "safeguard"),
        (1 << 9 | 1 << 10, 3, 1, False, "protective-stop", "reports a fault"),
        (1 << 6 | 1 << 7 | 1 << 10, 3, 1, False, "emergency-stop", "release it"),
    ],
)
def test_states_of_the_controller_are_conditions(
    bits: int, robot: int, runtime: int, controls: bool, kind: str, says: str
) -> None:
    found = read_condition("Ur5e-1", bits, robot, runtime, controls=controls)
    assert found.kind == kind
    assert says in found.sentence
    assert bool(found.sentence) == (kind not in ("ready", "in-control"))
