"""What is read of a URDF or MJCF is the arm; what cannot be one is refused in a sentence with the cure."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robot_import.arms import GEN3, railed, six
from skillc.errors import RequestError
from skillc.services.robot_import.arm_reader import Reading, ReadOptions
from skillc.services.robot_import.comparison import POSTURES, TOLERANCE, Kinetics, prove_same
from skillc.services.robot_import.home_posture import HomeSearch
from skillc.services.robot_import.mjcf_writer import write_mjcf
from skillc.services.robot_import.reader import read_robot
from skillc_ontology import catalogue
from skillc_runtime.control.inverse_kinematics import solve_inverse_kinematics
from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model

LAST = '  <link name="tool0"/>'
FINGERS = "".join(
    f'<link name="finger_{side}"/> <joint name="{side}" type="prismatic"> <parent link="tool0"/> '
    f'<child link="finger_{side}"/> <limit lower="0" upper="0.04" effort="10" velocity="1"/> </joint>'
    for side in ("left", "right")
)


def read(folder: Path, text: str, **options: Any) -> Reading:
    """Return what is read of a text."""
    file = folder / "six.urdf"
    file.write_text(text, "utf-8")
    return read_robot(file, ReadOptions(**options))


def written(folder: Path, reading: Reading) -> Path:
    """Write the model that is read."""
    path = folder / "out.xml"
    efforts = [link.joint.effort or 1.0 for link in reading.model.links]
    path.write_text(write_mjcf(reading.model, "six", "six.urdf", "torque", efforts), "utf-8")
    return path


def proved(folder: Path, reading: Reading) -> Kinetics:
    """Return how little the written model differs."""
    return prove_same(reading.model, reading.source, written(folder, reading))


def test_a_model_agrees_with_the_file_in_another_library(tmp_path: Path) -> None:
    assert POSTURES == 200
    for file in (GEN3, catalogue.model_path("robots/panda.xml"), catalogue.model_path("robots/ur5e.xml")):
        reading = read_robot(file)

        assert 0 < max(proved(tmp_path, reading)) < 1e-10


def test_a_joint_beside_the_arm_is_fixed_where_its_range_is_nearest_to_0(tmp_path: Path) -> None:
    beside = (
        '<link name="arm"> <inertial> <mass value="2"/> '
        '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/> </inertial> </link> '
        '<joint name="lid" type="prismatic"> <parent link="link_6"/> <child link="arm"/> '
        '<origin xyz="0 0 1" rpy="0 1.5707963 0"/> <axis xyz="0 0 3"/> <limit lower="{0}" upper="0.9"/> </joint>'
    )
    places = [read(tmp_path, six().replace(LAST, beside.format(low) + LAST), tip="tool0") for low in (-0.5, 0.5)]
    one, other = (reading.model.links[5].inertia for reading in places)
    assert (one.mass_kg, other.mass_kg) == pytest.approx((3.5, 3.5))
    assert other.centre - one.centre == pytest.approx([0.5 * 2 / 3.5, 0, 0], abs=1e-6)


def test_what_is_fixed_to_a_link_is_part_of_it(tmp_path: Path) -> None:
    model = read(tmp_path, six()).model
    assert [link.name for link in model.links] == [f"link_{number}" for number in range(1, 7)]
    assert model.links[1].inertia.mass_kg == pytest.approx(3.5 + 0.4)
    assert (model.base.name, model.tip) == ("base_link", "tool0")
    assert model.flange.position == pytest.approx([0, 0, 0.04])
    assert model.links[1].joint.axis == pytest.approx([0, 1, 0]), "an axis of length 2"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('mass="3.9"', 'mass="3.90001"'),
        ('name="joint_3" axis="0 1 0"', 'name="joint_3" axis="0 -1 0"'),
        ('fullinertia="0.02 ', 'fullinertia="0.02001 '),
        (' pos="0 0 0.4"', ' pos="0 0 0.4000001"'),
    ],
)
def test_a_model_that_differs_is_refused(old: str, new: str, tmp_path: Path) -> None:
    reading = read(tmp_path, six())
    path = written(tmp_path, reading)
    text = path.read_text("utf-8")
    assert old in text, text
    path.write_text(text.replace(old, new), "utf-8")
    with pytest.raises(RequestError, match=r"differs from the file: .* nothing was written"):
        prove_same(reading.model, reading.source, path)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("<robot", "<robot><link", "this is not XML"),
        ('<robot name="six">', '<robot xmlns:xacro="http://ros.org/xacro"><xacro:include filename="a"/>', "xacro six"),
        ('<robot name="six">', '<sdf><robot/></sdf><robot name="six">', "not XML"),
        ("robot", "sdf", "neither URDF"),
        ('<link name="cover">', '<link name="link_1">', "two links called `link_1`"),
        ('<child link="cover"/>', '<child link="lid"/>', "the child of joint `screws`, `lid`, is no link"),
        ('<child link="cover"/>', '<child link="link_3"/>', "child of two joints"),
        ('<child link="cover"/>', "", 'no `<child link="..">`'),
        ('<parent link="base_link"/>', '<parent link="tool0"/>', "joined in a circle"),
        ('type="fixed"> <parent link="link_2"', 'type="screw"> <parent link="link_2"', "of type `screw`"),
        (LAST, f'<link name="alone"/>{LAST}', "2 links have no parent (base_link, alone)"),
        ('lower="-2.8" upper="2.8"', "", "joint `joint_1` cannot move: its limits are 0 and 0"),
        ('<axis xyz="0 2 0"/>', '<axis xyz="0 0 0"/>', "the axis of joint `joint_2` has length 0"),
        ('<axis xyz="0 2 0"/>', '<axis xyz="0 one 0"/>', "must have 3 number(s)"),
        ("<axis", '<mimic joint="joint_2"/> <axis', "follows another one (`<mimic>`)"),
        ('name="joint_1" type="revolute"', 'name="joint_1" type="floating"', "is floating: no motor moves it"),
        ('<mass value="4.0"/>', '<mass value="0"/>', "link `link_1` and what is fixed to it have no mass"),
        ('<mass value="4.0"/>', "", 'the `<inertial>` of link `link_1` has no `<mass value="..">`'),
        ('<mass value="4.0"/>', '<mass value="nan"/>', '`<mass value="nan">` must have 1 number(s)'),
        ('izz="0.001"', 'izz="0.1"', "'cover'; no real body has such moments of inertia"),
        ("link_2", "world", "a link with a joint above it cannot be called `world`"),
        ('link name="tool0"', 'link name="tool0"/> <link name="end"', "2 links have no parent"),
        ('lower="-2.8" upper="2.8"', 'lower="-355" upper="355"', "57 turns: ranges are in rad. Write 6.196 if"),
        ('velocity="2"/>', 'velocity="2"/> <safety_controller soft_lower_limit="3"/>', "its soft limits, 3 and 2.8,"),
        ("revolute", "fixed", "no joint moves between"),
    ],
)
def test_what_is_no_arm_is_refused_in_words(old: str, new: str, says: str, tmp_path: Path) -> None:
    text = six()
    assert old in text
    count = -1 if old in ("robot", "revolute", "link_2") else 1
    with pytest.raises(RequestError) as refused:
        read(tmp_path, text.replace(old, new, count))
    assert says in str(refused.value) and str(tmp_path) in str(refused.value)


def six_with(child: str, joint: str, kind: str) -> str:
    """Return the arm with a last link without the name of a flange, and one more joint on it."""
    more = (
        f'<link name="{child}"> <inertial> <mass value="0.1"/> <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" '
        f'ixz="0" iyz="0"/> </inertial> </link> <joint name="{joint}" type="{kind}"> <parent link="end"/> '
        f'<child link="{child}"/> <axis xyz="0 0 1"/> <limit lower="0" upper="0.04" effort="10" velocity="1"/> </joint>'
    )
    return six().replace("tool0", "end").replace("</robot>", f"{more}</robot>")


@pytest.mark.parametrize(
    ("child", "joint", "kind"),
    [("pad", "pinch", "prismatic"), ("pad", "gripper_joint", "revolute"), ("moving_jaw", "j7", "revolute")],
)
def test_a_gripper_with_one_joint_is_no_joint_of_the_arm(child: str, joint: str, kind: str, tmp_path: Path) -> None:
    text = six_with(child, joint, kind)
    with pytest.raises(RequestError, match=rf"the last joint, `{joint}`.* such as `end`, or --tip {child} if"):
        read(tmp_path, text)
    assert len(read(tmp_path, text, tip="end").model.links) == 6
    assert len(read(tmp_path, text, tip=child).model.links) == 7
    named = read(tmp_path, text.replace('"end"', '"tool0"'))
    assert named.model.tip == "tool0" and any("beyond `tool0` is left out" in note for note in named.notes)
    mjcf = written(tmp_path, read(tmp_path, text, tip=child))
    mjcf.write_text(mjcf.read_text("utf-8").replace('site name="flange"', 'site name="pads"'), "utf-8")
    with pytest.raises(RequestError, match=rf"the last joint, `{joint}`"):
        read_robot(mjcf)


def test_a_hand_with_two_fingers_is_left_out_at_a_flange_and_asked_for_elsewhere(tmp_path: Path) -> None:
    assert read(tmp_path, six().replace(LAST, FINGERS + LAST)).model.tip == "tool0"
    with pytest.raises(RequestError, match="goes on in 2 ways, with joints `left`, `right`; name the link on which"):
        read(tmp_path, six().replace(LAST, FINGERS + LAST).replace("tool0", "palm"))


def test_a_file_with_a_place_that_is_no_number_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # MuJoCo writes a log there.
    path = written(tmp_path, read(tmp_path, six()))
    path.write_text(path.read_text("utf-8").replace('pos="0 0 0.4"', 'pos="0 nan 0.4"'), "utf-8")
    with pytest.raises(RequestError, match="differs from the file: poses by nan"):
        proved(tmp_path, read_robot(path))


def test_soft_limits_are_the_range_and_said(tmp_path: Path) -> None:
    soft = 'velocity="2"/> <safety_controller soft_lower_limit="-2" soft_upper_limit="3" k_velocity="1"/>'
    reading = read(tmp_path, six().replace('velocity="2"/>', soft, 1))
    assert [(link.joint.low, link.joint.high) for link in reading.model.links[:2]] == [(-2, 2.8), (-2.8, 2.8)]
    assert any("soft limits" in note and "joint_1;" in note for note in reading.notes)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("axis", "low", "high"), [("1 0 0", 0, 5), ("0 1 0", 0, 3), ("1 0 0", -9, -4), ("0 0 1", 0, 1)]
)
def test_an_arm_on_a_long_rail_has_a_home_in_the_middle_of_it(axis: str, low: int, high: int, tmp_path: Path) -> None:
    text = railed().replace('<axis xyz="0 1 0"/> <limit lower="-0.35" upper="0.35"', f'<axis xyz="{axis}"/> <limit '
        f'lower="{low}" upper="{high}"')  # fmt: skip
    assert text != railed()
    home = HomeSearch(written(tmp_path, read(tmp_path, text, tip="tool0"))).find()
    assert home is not None
    assert abs(home[0] - (low + high) / 2) < (high - low) / 3


def test_inertia_of_no_real_body_is_refused_with_its_link(tmp_path: Path) -> None:
    with pytest.raises(RequestError, match=r"link_1.*no real body has such moments of inertia"):
        read(tmp_path, six().replace('izz="0.01"', 'izz="0.1"', 1))
    corrected = read(tmp_path, six().replace('izz="0.01"', 'izz="0.1"', 1), correct_inertia=True)
    assert any(
        "moments of inertia of link_1:" in note and "changes the mass matrix by" in note for note in corrected.notes
    )
    assert max(proved(tmp_path, corrected)) < TOLERANCE
    moments = np.linalg.eigvalsh(corrected.model.links[0].inertia.matrix)
    assert moments[0] + moments[1] == pytest.approx(moments[2], rel=1e-5)


@pytest.mark.parametrize("moments", ['fullinertia="0.02 0.025 0.1 0.001 0 -0.002"', 'diaginertia="0.02 0.03 0.1"'])
def test_moments_of_an_mjcf_are_raised_so_that_a_body_can_have_them(moments: str, tmp_path: Path) -> None:
    path = written(tmp_path, read(tmp_path, six()))
    text = path.read_text("utf-8")
    whole = text[text.index('fullinertia="') :].split('"')[1]
    path.write_text(text.replace(f'fullinertia="{whole}"', moments, 1), "utf-8")
    with pytest.raises(RequestError, match=r"link_1.*no real body has such moments of inertia"):
        read_robot(path)
    corrected = read_robot(path, ReadOptions(correct_inertia=True))
    assert any("moments of inertia of link_1:" in note and "by at most" in note for note in corrected.notes)
    raised = np.linalg.eigvalsh(corrected.model.links[0].inertia.matrix)
    assert raised[0] + raised[1] == pytest.approx(raised[2], rel=1e-5) and raised[2] == pytest.approx(0.1, rel=1e-3)
    assert max(proved(tmp_path, corrected)) < TOLERANCE


@pytest.mark.parametrize(
    ("old", "new", "options", "note"),
    [
        (LAST, FINGERS + LAST, {"tip": "tool0"}, "what is beyond `tool0` is left out"),
        (LAST, FINGERS.replace('link="tool0"', 'link="link_6"') + LAST, {"tip": "tool0"}, "left, right do not belong"),
        ('joint_4" type="revolute"', 'joint_4" type="continuous"', {}, "without end: joint_4;"),
        ('velocity="2"', 'velocity="120"', {}, "speeds of more than 20 rad/s, 1146 deg/s: joint_1"),
        ("<axis", '<dynamics damping="0.1"/><axis', {}, "damping and friction of joints"),
        ("<cylinder", '<mesh filename="package://none/a.stl"/><cylinder', {}, "a.stl"),
        ('<child link="tool0"/> <origin', '<child link="tool0"/> <origin rpy="0 1.57 0"', {}, "the z axis of `tool0`"),
        ('joint_1" type="revolute"', 'joint_1" type="prismatic"', {}, "sliding: joint_1;"),
    ],
)
def test_what_a_user_should_know_is_said(
    old: str, new: str, options: dict[str, str], note: str, tmp_path: Path
) -> None:
    assert old in six()
    reading = read(tmp_path, six().replace(old, new, 1), **options)
    assert any(note in each for each in reading.notes), reading.notes
    assert max(proved(tmp_path, reading)) < TOLERANCE


def test_names_may_be_in_any_script_and_the_same_for_links_and_joints(tmp_path: Path) -> None:
    text = six().replace("link_3", "Ellbogen-Stück").replace("joint_3", "関節3")
    text = text.replace("link_2", "universe").replace("joint_2", "universe")
    reading = read(tmp_path, text)
    assert reading.model.links[2].joint.name == "関節3"
    assert max(proved(tmp_path, reading)) < TOLERANCE


def test_the_flange_may_be_turned(tmp_path: Path) -> None:
    file = tmp_path / "six.urdf"
    file.write_text(six(), "utf-8")
    model = read_robot(file, ReadOptions(tip="link_6", tip_turn=(0.0, 90.0, 0.0))).model
    assert model.flange.rotation[:, 2] == pytest.approx([1, 0, 0])


def test_missing_numbers_of_motors_are_none(tmp_path: Path) -> None:
    model = read(tmp_path, six().replace('effort="80" velocity="2"', 'effort="0"', 1)).model
    assert (model.links[0].joint.effort, model.links[0].joint.speed) == (None, None)
    assert (model.links[1].joint.effort, model.links[1].joint.speed) == (80, 2)


def test_masses_of_both_formats_are_the_same(tmp_path: Path) -> None:
    reading = read(tmp_path, six())
    again = read_robot(written(tmp_path, reading))
    pairs = list(zip(reading.model.links, again.model.links, strict=True))
    assert len(pairs) == 6
    for one, other in pairs:
        assert (one.joint.name, one.joint.low, one.joint.effort) == (
            other.joint.name,
            other.joint.low,
            other.joint.effort,
        )
        assert np.allclose(one.joint.axis, other.joint.axis)
        assert np.allclose(one.inertia.matrix, other.inertia.matrix, atol=1e-9)
        assert [shape.kind for shape in one.shapes] == [shape.kind for shape in other.shapes]


def test_a_long_rail_is_not_turned_by_whole_turns(tmp_path: Path) -> None:
    reading = read(tmp_path, railed().replace('lower="-0.35" upper="0.35"', 'lower="-9" upper="9"'), tip="tool0")
    arm = VirtualArm(load_virtual_model(written(tmp_path, reading)))
    assert [arm.joint_unit(joint) for joint in range(arm.joints)] == ["m", *["rad"] * 6]
    limits = np.array([(link.joint.low, link.joint.high) for link in reading.model.links])
    seed = np.array([0.0, 0.0, 0.2, -1.5, 0.0, 1.43, 0.0])
    arm.update_kinematics(seed + np.array([6.0, *[0.0] * 6]))
    target = arm.tool
    found = solve_inverse_kinematics(arm, target, seed, limits)
    assert found is not None
    arm.update_kinematics(found)
    assert np.allclose(arm.tool.position, target.position, atol=1e-4)


@pytest.mark.parametrize(
    ("flange_m", "shapes", "note"), [(0.06, ["cylinder"], "or a cylinder to the flange"), (0.02, [], "nothing looks")]
)
def test_the_last_link_without_a_shape_reaches_to_the_flange_or_is_said_not_to_be_looked_at(
    flange_m: float, shapes: list[str], note: str, tmp_path: Path
) -> None:
    before, after = six().rsplit("<collision>", 1)
    bare = before + after.split("</collision>", 1)[1]
    reading = read(tmp_path, bare.replace('xyz="0 0 0.04"', f'xyz="0 0 {flange_m}"'))
    assert [each.kind for each in reading.model.links[-1].shapes] == shapes
    assert any("`link_6`" in each and note in each for each in reading.notes), reading.notes
    for each in reading.model.links[-1].shapes:
        assert each.pose.apply(np.array([0.0, 0.0, each.size[1]])) == pytest.approx([0, 0, flange_m])
