"""What a URDF says of a robot, beside the model of its facts: frames may differ, axes and their order may not."""

from __future__ import annotations

import re

import mujoco
import numpy as np
import pytest

from robots.ros2.describing import describe
from skillc_ontology import catalogue
from skillc_runtime.backends.ros2.described_robot import find_difference

ARMS = ("ur5e", "iiwa14", "panda", "fr3")
Q = np.array([0.3, -1.2, 0.9, -1.1, 0.7, 0.4, 0.2])


def model_of(arm: str) -> str:
    return str(catalogue.model_path(f"robots/{arm}.xml"))


def described(arm: str) -> tuple[str, list[str]]:
    """Return the URDF of an arm, and the names of its joints."""
    model = mujoco.MjModel.from_xml_path(model_of(arm))
    return describe(model, "", {}), [model.joint(j).name for j in range(model.njnt)]


@pytest.mark.parametrize("arm", ARMS)
def test_the_robot_of_the_model_has_no_difference(arm: str) -> None:
    urdf, names = described(arm)
    assert find_difference(urdf, names, model_of(arm), Q[: len(names)]) is None


@pytest.mark.parametrize("arm", ARMS)
def test_any_two_joints_that_are_exchanged_are_found(arm: str) -> None:
    urdf, names = described(arm)
    found = 0
    for first in range(len(names)):
        for second in range(first):
            wrong, q = [*names], Q[: len(names)].copy()
            wrong[first], wrong[second] = wrong[second], wrong[first]
            q[[first, second]] = q[[second, first]]
            found += find_difference(urdf, wrong, model_of(arm), q) is not None
    assert found == len(names) * (len(names) - 1) / 2


@pytest.mark.parametrize("arm", ARMS)
def test_a_joint_that_turns_the_other_way_is_named(arm: str) -> None:
    urdf, names = described(arm)
    name = names[1]
    axis = re.compile(rf'(name="{name}".*?axis xyz=")([^"]*)')
    turned = axis.sub(lambda it: it[1] + " ".join(str(-float(x)) for x in it[2].split()), urdf, count=1)
    q = np.zeros(len(names))
    assert find_difference(turned, names, model_of(arm), q) == f"{name} turns opposite to the model"
    assert find_difference(turned, names, model_of(arm), Q[: len(names)]) is not None


def test_other_robots_and_what_is_no_description_are_reported() -> None:
    urdf, names = described("ur5e")
    model = model_of("ur5e")
    assert find_difference("<robot", names, model, Q[:6]).startswith("the URDF cannot be read")  # type: ignore[union-attr]
    assert find_difference(urdf, ["a", *names[1:]], model, Q[:6]) == "the robot has no joint a"
    longer = urdf.replace("-0.425", "-0.612")
    assert longer != urdf
    assert "mm from that of the model" in str(find_difference(longer, names, model, Q[:6]))
