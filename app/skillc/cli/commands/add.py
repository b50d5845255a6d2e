"""Add a skill, robot, gripper or tool to the project here."""

from __future__ import annotations

import platform
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_device
from skillc.cli.console import print_labelled, print_remark
from skillc.cli.settings import GroupedOption

if TYPE_CHECKING:
    from skillc.services.project.project import Project
    from skillc.services.scaffolding.additions import Kind

model_option = partial(click.option, cls=GroupedOption, group="Model file")
MODELS = (".urdf", ".xml", ".mjcf", ".xacro", ".sdf")
"""An argument with one of these suffixes is a file with a model, any other one a name."""


@click.command(
    cls=Command,
    examples="""
    skillc add skill rinse_board
    skillc add gripper my_gripper --like wsg50
    skillc add tool sponge --size 0.15 0.08 0.04
    skillc add robot arm.urdf --like iiwa14
    """,
)
@click.argument("kind", metavar="KIND", type=click.Choice(["skill", "robot", "gripper", "tool"]))
@click.argument("name", metavar="NAME|FILE")
@click.option(
    "--like",
    metavar="DEVICE",
    shell_complete=complete_device,
    help="The shipped device to copy, such as `ur5e` or `wsg50`; with FILE, what has the numbers that FILE lacks.",
)
@click.option(
    "--size",
    nargs=3,
    type=float,
    metavar="X Y Z",
    help="The size of a new tool without its handle, in m. Weight and pad stiffness are computed from it.",
)
@model_option("--name", "called", metavar="NAME", help="The name of the arm; by default that of the file.")
@model_option(
    "--control",
    type=click.Choice(["torque", "position", "velocity"]),
    help="What the arm is commanded; by default as the arm of --like.",
)
@model_option("--base", metavar="LINK", help="The link that does not move; by default the root.")
@model_option("--tip", metavar="LINK", help="The link or site on which a gripper is mounted, z pointing out.")
@model_option(
    "--tip-turn",
    type=(float, float, float),
    default=(0.0, 0.0, 0.0),
    metavar="R P Y",
    help="Roll, pitch and yaw of the flange in the frame of the tip, in degrees.",
)
@model_option(
    "--correct-inertia",
    is_flag=True,
    help="Raise moments of inertia that no body can have, and say how much.",
)
@model_option("--efforts", metavar="NUMBERS", help="The greatest effort of each joint, N m.")
@model_option("--home", metavar="NUMBERS", help="The home posture, rad; by default one is proposed.")
@model_option(
    "--set",
    "settings",
    metavar="PROPERTY=VALUE",
    multiple=True,
    help="A value of the data sheet in SI units, such as forceLimit=40; may be repeated.",
)
def command(
    kind: Kind, name: str, like: str | None, size: tuple[float, ...] | None, called: str | None, **options: Any
) -> None:
    """Add a skill, robot, gripper or tool called NAME to the project here, or the arm of a URDF or MJCF FILE.

    A skill is a `.skill` file. A robot, gripper or tool is a data sheet and a model in the project's ontology folder,
    copied from a shipped device, to be replaced by your numbers.

    The arm of a FILE has its kinematics, inertia and joint limits, which are compared with the file by another library
    than the one that read it. What no model states is taken from the options and from the arm of --like; what then is
    still to be stated is listed by `skillc check`.
    """
    from skillc.errors import RequestError
    from skillc.services.project.loading import find_project
    from skillc.services.scaffolding.additions import add_files, add_resized_tool

    project = find_project(Path())
    if project is None:
        raise RequestError("there is no skillc.toml here or above; `skillc new NAME` writes a project")
    if size is not None and kind != "tool":
        raise RequestError("--size is for `skillc add tool`")
    if kind == "robot" and (Path(name).suffix.lower() in MODELS or "/" in name):
        _add_robot(project, Path(name), like, called, **options)
        return
    given = [f"--{key.replace('_', '-')}" for key, value in {"name": called, **options}.items() if _is_given(value)]
    if given:
        raise RequestError(
            f"{given[0].replace('settings', 'set')} is for `skillc add robot FILE`, with a URDF or MJCF file"
        )
    if size is not None:
        files, stated = add_resized_tool(project, name, like, size)
        print_remark(f"write in a scene, for a thing of the class of the copied tool: {stated} .")
    else:
        files = add_files(project, kind, name, like)
    for path in files:
        click.echo(path)


def _is_given(value: Any) -> bool:
    return value is not None and value != () and value is not False and value != (0.0, 0.0, 0.0)


def _add_robot(
    project: Project, file: Path, like: str | None, called: str | None, settings: tuple[str, ...], **options: Any
) -> None:
    from skillc.errors import RequestError
    from skillc.extras import require

    if platform.system() == "Windows":
        raise RequestError(
            "models of robots are compared with pinocchio, which there is not for Windows: use Linux, macOS or WSL, or "
            "`skillc add robot NAME --like ARM` and replace the numbers"
        )
    require("reading models of robots", "robots")
    from skillc.services.robot_import.add_robot import RobotRequest, add_robot
    from skillc.services.robot_import.arm_reader import ReadOptions

    wrong = [each for each in settings if "=" not in each]
    if wrong:
        raise RequestError(f"--set {wrong[0]}: write PROPERTY=VALUE, such as forceLimit=40")
    stated = {name: value for name, _, value in (each.partition("=") for each in settings)}
    part = ReadOptions(*(options.pop(name) for name in ("base", "tip", "tip_turn", "correct_inertia")))
    added = add_robot(project, RobotRequest(file, called, like, part=part, settings=stated, **options))
    for path in added.files:
        click.echo(path)
    for remark in added.remarks:
        print_remark(remark)
    for warning in added.warnings:
        print_labelled("warning", warning)
