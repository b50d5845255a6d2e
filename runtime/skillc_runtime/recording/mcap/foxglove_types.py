"""The messages of Foxglove that recordings have, as its documentation describes them, and their JSON Schemas.

Recordings make thousands of the small ones in a second. They cannot refer to themselves, so no garbage is looked for in
them.
"""

from __future__ import annotations

import json
from typing import Any

import msgspec


class Time(msgspec.Struct, frozen=True, gc=False):
    sec: int
    nsec: int


class Duration(msgspec.Struct, frozen=True, gc=False):
    sec: int
    nsec: int


class Vector3(msgspec.Struct, frozen=True, gc=False):
    x: float
    y: float
    z: float


class Quaternion(msgspec.Struct, frozen=True, gc=False):
    x: float
    y: float
    z: float
    w: float


class Pose(msgspec.Struct, frozen=True, gc=False):
    position: Vector3
    orientation: Quaternion


class Color(msgspec.Struct, frozen=True, gc=False):
    """Each from 0 to 1."""

    r: float
    g: float
    b: float
    a: float


class FrameTransform(msgspec.Struct, frozen=True, gc=False):
    timestamp: Time
    parent_frame_id: str
    child_frame_id: str
    translation: Vector3
    rotation: Quaternion


class FrameTransforms(msgspec.Struct, frozen=True):
    transforms: list[FrameTransform]


class ArrowPrimitive(msgspec.Struct, frozen=True, gc=False):
    """It points along the x axis of its pose; lengths are in m."""

    pose: Pose
    shaft_length: float
    shaft_diameter: float
    head_length: float
    head_diameter: float
    color: Color


class CubePrimitive(msgspec.Struct, frozen=True, gc=False):
    pose: Pose
    size: Vector3
    color: Color


class SpherePrimitive(msgspec.Struct, frozen=True, gc=False):
    pose: Pose
    size: Vector3
    color: Color


class CylinderPrimitive(msgspec.Struct, frozen=True, gc=False):
    """Its axis is the z axis of its pose; the scales are those of its ends, from 0 to 1."""

    pose: Pose
    size: Vector3
    bottom_scale: float
    top_scale: float
    color: Color


class SceneEntity(msgspec.Struct, frozen=True, kw_only=True):
    """What is drawn in a frame; it replaces the entity with the same id. Lists of `dict` are always empty here."""

    timestamp: Time
    frame_id: str
    id: str
    lifetime: Duration = Duration(0, 0)
    frame_locked: bool = True
    metadata: list[dict[str, str]] = []
    arrows: list[ArrowPrimitive] = []
    cubes: list[CubePrimitive] = []
    spheres: list[SpherePrimitive] = []
    cylinders: list[CylinderPrimitive] = []
    lines: list[dict[str, str]] = []
    triangles: list[dict[str, str]] = []
    texts: list[dict[str, str]] = []
    models: list[dict[str, str]] = []


class SceneUpdate(msgspec.Struct, frozen=True):
    deletions: list[dict[str, str]]
    entities: list[SceneEntity]


TITLES = {"Time": "time", "Duration": "duration"}
"""The titles of schemas; those of other types are `foxglove.NAME`."""


def make_foxglove_schema(kind: type[msgspec.Struct]) -> bytes:
    """Return the JSON Schema of a message, without references."""
    (_,), components = msgspec.json.schema_components((kind,), ref_template="{name}")
    return json.dumps(_expand({"$ref": kind.__name__}, components)).encode()


def _expand(schema: Any, components: dict[str, Any]) -> Any:
    if isinstance(schema, list):
        return [_expand(each, components) for each in schema]
    if not isinstance(schema, dict):
        return schema
    if "$ref" in schema:
        name = schema["$ref"]
        return {**_expand(components[name], components), "title": TITLES.get(name, f"foxglove.{name}")}
    return {key: _expand(value, components) for key, value in schema.items() if key != "default"}
