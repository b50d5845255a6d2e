"""What the facts of a cell must say of a robot is told before anything is connected; no robot and no library needed."""

from __future__ import annotations

import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from projects.folders import checked, write_project
from robots.franka import limits
from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_runtime.backends.franka.cell import describe, make_backend
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.control.kinematics import JOINT_RAMP_S
from skillc_runtime.devices.backend import BackendStart, BackendUnavailable
from skillc_runtime.motion.paths.joint_path import joint_path
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.data_sheet import DataSheet, SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import SKILLC

AT = 'skiros:DriverAddress "127.1.2.3" ;'


def world(folder: Path, facts: str) -> WorldModel:
    text = catalogue.scene_path("panda_desk").read_text("utf-8").replace("skillc:panda-sheet", "skillc:fr3-sheet")
    text = text.replace("skillc:Panda ;", f"skillc:Fr3 ; {facts}")
    text = "@prefix franka: <https://w3id.org/skillc/franka#> .\n" + text
    (folder / "cell.ttl").write_text(text, "utf-8")
    return WorldModel(load_scene(folder / "cell.ttl", libraries.load_vocabulary()))


def test_the_address_and_the_reflex_are_those_of_the_arm_or_its_sheet(tmp_path: Path) -> None:
    (arm,) = read_scene_spec(world(tmp_path, AT).snapshot()).arms
    told = describe(arm)
    assert told.name == "the robot at 127.1.2.3"
    assert (told.model.name, told.gravity, told.rest_torque_n_m) == ("fr3.xml", (0.0, 0.0, -9.81), 2.5)
    assert told.reflex_torques == (80.0, 80.0, 70.0, 70.0, 12.0, 12.0, 12.0)
    (arm,) = read_scene_spec(world(tmp_path, f'{AT} franka:reflexForces "50 50 50 9 9 9" ;').snapshot()).arms
    assert describe(arm).reflex_forces == (50.0, 50.0, 50.0, 9.0, 9.0, 9.0)


@pytest.mark.parametrize("joint", range(7))
@pytest.mark.parametrize("share", [0.1, 1.0])
def test_motions_to_the_ends_of_the_joints_keep_the_limits_of_speed_that_fall_there(joint: int, share: float) -> None:
    scene = load_scene(catalogue.scene_path("panda_desk"), libraries.load_vocabulary())
    sheet = DataSheet(scene, SKILLC + "fr3-sheet")
    speed, most = sheet.limits("jointSpeeds", 7), sheet.limits("jointAccelerations", 7)
    ends = mujoco.MjModel.from_xml_path(str(catalogue.model_path("robots/fr3.xml"))).jnt_range
    for end in (0, 1):
        start, goal = ends.mean(axis=1), ends.mean(axis=1)
        goal[joint] = ends[joint, end]
        path = joint_path([start, goal], share * speed, np.minimum(share * speed / JOINT_RAMP_S, most), [])
        for time in np.linspace(0.0, path.duration, 2000).tolist():
            here = path.at(time)
            low, high = limits.fastest(here.q)
            assert low[joint] - 1e-9 <= here.dq[joint] <= high[joint] + 1e-9, (here.q[joint], here.dq[joint])


@pytest.mark.parametrize(
    ("facts", "says"),
    [
        ("", r"lab:Panda-1 has no skiros:DriverAddress: state the address of the robot"),
        (
            f'{AT} franka:reflexForces "50 50 50" ;',
            r"must be 6 numbers above 0: '50 50 50'",
        ),
        (f'{AT} franka:reflexTorques "1 1 1 1 1 1 x" ;', "must be 7 numbers above 0"),
        (f"{AT} franka:restTorque -1.0 ;", "must be a number above 0"),
        (
            f"{AT} skillc:stateTimeout 0.2 ;",
            "pylibfranka waits 1 s for a state, and nothing changes that; leave it out",
        ),
    ],
)
def test_what_is_missing_or_wrong_is_told(tmp_path: Path, facts: str, says: str) -> None:
    (arm,) = read_scene_spec(world(tmp_path, facts).snapshot()).arms
    with pytest.raises(SheetError, match=says):
        describe(arm)


def test_without_the_library_it_is_said_how_to_install_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pylibfranka", None)
    skills = write_project(tmp_path / "project", 'name = "sorting"\n[tool.run]\nbackend = "franka"\n')
    (found,) = checked(skills)
    assert (found["name"], found["line"]) == ("wrong-setting", 3)
    assert "needs what is not installed (pylibfranka): pip install 'skillc[franka]'" in found["message"]
    with pytest.raises(BackendUnavailable, match=r"pylibfranka cannot be imported.*pip install 'skillc\[franka\]'"):
        make_backend(world(tmp_path, AT), BackendStart())
