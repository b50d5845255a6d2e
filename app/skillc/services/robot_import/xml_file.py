"""Reads the XML of a robot's model; what cannot be one is a RequestError."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, TypeAlias
from xml.etree import ElementTree

from skillc.errors import RequestError

Format: TypeAlias = Literal["urdf", "mjcf"]

LARGEST_BYTES = 20_000_000
"""Larger files are not read; models without their meshes have some 10 kB."""


def read_xml(path: Path) -> tuple[Format, ElementTree.Element]:
    """Return the format of a robot's model and its root element. RequestError if it is not URDF or MJCF."""
    root = _parse(path)
    tag = local_tag(root)
    if path.suffix == ".xacro" or any("xacro" in each.tag for each in root.iter() if isinstance(each.tag, str)):
        raise RequestError(
            f"{path} has xacro macros, which have to be expanded first: `pip install xacro`, then "
            f"`xacro {path.name} > {path.name.split('.')[0]}_expanded.urdf`, with the arguments of the file as "
            "NAME:=VALUE"
        )
    if tag == "robot":
        return "urdf", root
    if tag == "mujoco":
        return "mjcf", root
    hint = "; SDF can be converted with `gz sdf`, or export URDF" if tag == "sdf" else ""
    raise RequestError(f"{path} is neither URDF (`<robot>`) nor MJCF (`<mujoco>`): it begins with `<{tag}>`{hint}")


def local_tag(element: ElementTree.Element) -> str:
    """Return the tag of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


def _parse(path: Path) -> ElementTree.Element:
    try:
        if path.is_dir():
            raise RequestError(f"{path} is a folder; name the URDF or MJCF file in it")
        if path.stat().st_size > LARGEST_BYTES:
            raise RequestError(
                f"{path} has more than {LARGEST_BYTES // 1_000_000} MB; a model has its meshes in other files"
            )
        return ElementTree.fromstring(path.read_bytes())
    except OSError as error:
        raise RequestError(f"{path} cannot be read: {error.strerror}") from error
    except ElementTree.ParseError as error:
        line, column = error.position
        what = str(error).partition(":")[0]
        raise RequestError(f"{path}:{line}:{column + 1}: this is not XML: {what}") from error
    except (ValueError, LookupError) as error:
        raise RequestError(f"{path} is not XML: {error}") from error
