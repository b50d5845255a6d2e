"""Shipped scenes with the facts that the simulated robots of these tests need."""

from __future__ import annotations

from pathlib import Path

from skillc_ontology import catalogue

ROS2 = "@prefix ros2: <https://w3id.org/skillc/ros2#> .\n"
TIMEOUTS = ("treeTimeout", "controlTimeout", "cycleTimeout")
SLOW = "ros2:updateRate {rate_hz} ; skillc:stateTimeout 1.0 ; " + " ; ".join(f"skillc:{each} 5.0" for each in TIMEOUTS)
"""Machines that run tests beside each other are slow: all may be silent for longer than with a real robot."""


def whiteboard(folder: Path) -> Path:
    """Write the scene of the UR5e at the whiteboard, for ROS 2; return the file."""
    facts = f"""
lab:Ur5e-1 {SLOW.format(rate_hz=125.0)} .
lab:Wsg-1 ros2:effortTopic "gripper_controller/max_effort" ; skillc:stateTimeout 2.0 .
lab:Heron-1 skillc:stateTimeout 2.0 .
lab:Whiteboard-1 ros2:cleanShareTopic "Whiteboard_1/clean_share" .
"""
    return _write("ur5e_whiteboard", facts, folder)


CARTESIAN = """
lab:Wrist-1 a skillc:ForceTorqueSensor .
skillc:iiwa14-sheet skillc:forceTorqueTime 0.001 .
lab:Iiwa-1 skillc:hasSensor lab:Wrist-1 ;
    ros2:targetPoseTopic "cartesian_controller/reference_pose" ;
    skiros:CartesianStiffnessTopic "cartesian_controller/set_cartesian_stiffness" ;
    skiros:CartesianWrenchTopic "cartesian_controller/set_cartesian_wrench" ;
    skiros:JointConfigurationController "cartesian_controller" ;
    ros2:commandType "trajectory_msgs/msg/JointTrajectory" ;
    skiros:LinkedToFrameId "base_link" ; skiros:MoveItTCPLink "flange" .
"""
"""The facts of an arm whose compliant law runs on the robot's side."""


def cartesian_table(folder: Path) -> Path:
    """Write the scene of an iiwa whose law runs on the robot's side, for ROS 2; return the file."""
    path = table(folder, 250.0)
    text = path.read_text("utf-8").replace('CompliantController "impedance"', 'CompliantController "on_robot"')
    path.write_text(text + CARTESIAN, "utf-8")
    return path


def button(folder: Path) -> Path:
    """Write the scene of the UR5e before a button, for ROS 2; return the file."""
    facts = f"""
lab:Ur5e-1 {SLOW.format(rate_hz=125.0)} .
lab:Wsg-1 ros2:effortTopic "gripper_controller/max_effort" ; skillc:stateTimeout 2.0 .
lab:Button-1 ros2:switchedTopic "Button_1/switched" .
"""
    return _write("ur5e_button", facts, folder)


def parts(folder: Path) -> Path:
    """Write the scene of a UR5e, a part and a box, for ROS 2; return the file."""
    path = folder / "parts.ttl"
    scene = (Path(__file__).parents[1] / "ur" / "parts.ttl").read_text("utf-8")
    path.write_text(
        f"{ROS2}{scene}\nlab:Ur5e-1 {SLOW.format(rate_hz=125.0)} .\nlab:Wsg-1 skillc:stateTimeout 2.0 .\n", "utf-8"
    )
    return path


def table(folder: Path, rate_hz: float) -> Path:
    """Write the scene of the iiwa at the table, for ROS 2; return the file."""
    facts = f"""
lab:Iiwa-1 {SLOW.format(rate_hz=rate_hz)} ; ros2:carriesWeight false .
lab:Robotiq-1 ros2:effortTopic "gripper_controller/max_effort" ; skillc:stateTimeout 2.0 .
lab:Table-1 ros2:cleanShareTopic "Table_1/clean_share" .
"""
    return _write("iiwa_table", facts, folder)


def _write(scene: str, facts: str, folder: Path) -> Path:
    path = folder / f"{scene}.ttl"
    path.write_text(ROS2 + catalogue.scene_path(scene).read_text("utf-8") + facts, "utf-8")
    return path
