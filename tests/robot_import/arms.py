"""A small arm with six joints as URDF, which tests change, and larger ones from files."""

from __future__ import annotations

from pathlib import Path

GEN3 = Path(__file__).parent / "gen3.urdf"
LIFTER = Path(__file__).parent / "lifter.urdf"
"""An invented arm: six joints with odd names, two of them without end, on a fixed plinth, with a two-finger gripper."""
LINK = """\
  <link name="link_{0}">
    <inertial>
      <origin xyz="0.01 0.02 {2}" rpy="0.1 0 0"/> <mass value="{1}"/>
      <inertia ixx="0.02" iyy="0.025" izz="0.01" ixy="0.001" ixz="0" iyz="-0.002"/>
    </inertial>
    <collision> <origin xyz="0 0 {2}"/> <geometry> <cylinder radius="0.05" length="0.12"/> </geometry> </collision>
  </link>
"""
JOINT = """\
  <joint name="joint_{0}" type="revolute">
    <parent link="{1}"/> <child link="link_{0}"/> <origin xyz="{2}"/>
    <axis xyz="{3}"/> <limit lower="-2.8" upper="2.8" effort="80" velocity="2"/>
  </joint>
"""
PLACES = ("0 0 0.1", "0 0 0.2", "0 0 0.4", "0 0 0.2", "0 0 0.2", "0 0 0.08")
AXES = ("0 0 1", "0 2 0", "0 1 0", "0 0 1", "0 1 0", "0 0 1")


def six() -> str:
    """Return the URDF of an arm with six joints, a cover on its second link, and a frame `tool0` on the last one."""
    parts = ['<robot name="six">\n  <link name="base_link"/>\n']
    for number, (place, axis) in enumerate(zip(PLACES, AXES, strict=True), 1):
        above = f"link_{number - 1}" if number > 1 else "base_link"
        parts += [LINK.format(number, 4.5 - 0.5 * number, 0.02 * number), JOINT.format(number, above, place, axis)]
    parts.append(
        '  <link name="cover"> <inertial> <mass value="0.4"/> <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" '
        'ixz="0" iyz="0"/> </inertial> </link>\n'
        '  <joint name="screws" type="fixed"> <parent link="link_2"/> <child link="cover"/> '
        '<origin xyz="0.05 0 0.2" rpy="0 0.3 0"/> </joint>\n'
        '  <link name="tool0"/>\n  <joint name="mount" type="fixed"> <parent link="link_6"/> <child link="tool0"/> '
        '<origin xyz="0 0 0.04"/> </joint>\n</robot>\n'
    )
    return "".join(parts)


def railed() -> str:
    """Return the URDF of the lifter on a cart that slides 0.35 m to either side along y; its joint is `rail`."""
    cart = (
        ' <link name="cart"> <inertial> <mass value="8"/> <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" '
        'iyz="0"/> </inertial> </link>\n <joint name="rail" type="prismatic"> <parent link="plinth"/> '
        '<child link="cart"/> <axis xyz="0 1 0"/> <limit lower="-0.35" upper="0.35" effort="600" velocity="0.6"/> '
        "</joint>\n"
    )
    text, foot = LIFTER.read_text("utf-8"), '<parent link="plinth"/>'
    assert text.count(foot) == 1
    return text.replace(foot, foot.replace("plinth", "cart")).replace("</robot>", f"{cart}</robot>")
