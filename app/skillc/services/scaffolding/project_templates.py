"""The templates of `skillc new`: what each is about. Its files are in `templates/NAME`, those of all in `common`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from skillc_model import templates

if TYPE_CHECKING:
    from jinja2 import Environment

FOLDER = Path(__file__).parent / "templates"
DEFAULT = "press"


@dataclass(frozen=True, slots=True)
class Template:
    """A template: a summary, what its skills, its scene and a first change are, and the skills of its plan, sorted.

    `{skill}` in a text stands for the name of the project as the name of a skill. `own_files` are files that no other
    template has, `extras` what it needs beside `run` and `planner`.
    """

    name: str
    summary: str
    skills: str
    scene: str
    change: str
    steps: tuple[str, ...]
    own_files: tuple[str, ...] = ()
    extras: tuple[str, ...] = ()


TEMPLATES = (
    Template(
        "pick-place",
        "an arm puts two parts into two boxes, and a camera looks where they are",
        "the classes of the parts and boxes",
        "robot, camera, table, parts, boxes and where they are",
        "add a third part, which `lab:Cell` contains, to `cell.ttl` and the goal, change a box, or use another arm",
        ("Pick", "Pick", "Place", "Place"),
    ),
    Template(
        "wipe",
        "an arm fetches an eraser and wipes a board",
        "the class of the surface",
        "robot, eraser, board and where they are",
        "change `wiping:normalForce`, or the size of the board",
        ("Pick", "Wipe"),
    ),
    Template(
        "press",
        "an arm fetches a tool and presses a panel, with a skill of its own",
        "the skill `{skill}` and its implementation",
        "robot, tool, panel and where they are",
        "set `pause` to 2 s, add a second panel and a task that presses it, or write another `impl` for another arm",
        ("Pick", "{skill}"),
    ),
    Template(
        "insert",
        "an arm fetches a pin and inserts it into a hole that it has to search",
        "the classes of the pin and the block",
        "robot, pin, block and where they are",
        "raise `contact:placeRange`, how far the hole may be from where it is believed to be",
        ("Insert", "Pick"),
    ),
    Template(
        "inspect",
        "a camera looks at parts, and an arm puts good ones into a rack and the others into the scrap",
        "the classes of the parts and boxes",
        "robot, cameras, tray, kinds of parts, parts, boxes and where they are",
        "set `skillc:defectRate` of a part to 1, or add a kind of parts with its own codes and colour",
        ("InspectPart",),
        extras=("vision",),
    ),
    Template(
        "inspect-by-arm",
        "the same with the camera on the flange of the arm, which takes it above each part",
        "the classes of the parts and boxes",
        "robot, cameras, tray, kinds of parts, parts, boxes and where they are",
        "state another pose of `lab:Eye-1` on the flange, or another sheet with the lens of your camera",
        ("InspectPartByArm",),
        extras=("vision",),
    ),
    Template(
        "blank",
        "an arm and one skill that moves it, to start from",
        "the skill `{skill}` and its implementation",
        "the robot",
        "add things with `skillc scene add cell.ttl`, and say in `{skill}` what to do with them",
        ("{skill}",),
        ("home.py",),
    ),
)


def open_templates() -> Environment:
    """Return the files of all templates."""
    return templates.open_templates(FOLDER, keeps_braces=True)
