"""What Foxglove shows of a recording is where the bodies of the simulation were, in messages that fit their schemas."""

from __future__ import annotations

import json
from contextlib import closing
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
from mcap.reader import make_reader

from recording.runs import CONTENTS
from skillc.services.library import libraries
from skillc.services.run.recordings import make_recorded_cell
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.mcap.foxglove import describe_forces
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

LAB = "http://example.org/lab#"


def test_frames_are_the_poses_of_the_bodies_and_messages_fit_their_schemas(tmp_path: Path) -> None:
    world = WorldModel(load_scene(catalogue.scene_path("panda_desk"), libraries.load_vocabulary()))
    with closing(KinematicCell(world)) as cell:
        file = RecordingFile(tmp_path / "a.mcap", lambda: CONTENTS, make_recorded_cell(cell))
        really: dict[int, tuple[Array, Array]] = {}
        cell.live.listeners.append(
            lambda: really.update({round(cell.now * 1e9): (cell.data.xpos.copy(), cell.data.xquat.copy())})
        )
        file.sample()
        arm = cell.arm(LAB + "Panda-1")
        arm.motion.move_joints(arm.measured.q + 0.3, 0.5)
        cell.advance(1.0)
        names = {cell.model.body(body).name: body for body in range(cell.model.nbody)}
        file.close()
    assert file.problem is None
    topics = read_messages(tmp_path / "a.mcap")
    (fixed,), frames = topics["/fixed_frames"], topics["/frames"]
    assert len(frames) == len(topics["/forces"]) == 25
    assert {each["child_frame_id"] for _, message in (fixed, frames[0]) for each in message["transforms"]} == {
        *names
    } - {"world"}
    for moment, message in (fixed, *frames):
        positions, quaternions = really[moment]
        for each in message["transforms"]:
            body, at, turned = names[each["child_frame_id"]], each["translation"], each["rotation"]
            assert np.allclose([at[axis] for axis in "xyz"], positions[body], atol=1e-5)
            assert np.allclose([turned[axis] for axis in "wxyz"], quaternions[body], atol=1e-5)
    moved = [[each["translation"] for each in message["transforms"]] for _, message in (frames[0], frames[-1])]
    assert moved[0] != moved[1], "the arm has moved"
    shown = {entity["frame_id"] for _, message in topics["/scene"] for entity in message["entities"]}
    assert any("Panda-1" in each for each in shown) and shown <= {*names}


def test_an_arrow_points_into_the_tool_and_is_longer_for_a_larger_force() -> None:
    upwards = np.array([1.0, 0.0, 0.0, 0.0])
    (none,), (some,) = (
        describe_forces(1.5, [("Eraser-1", np.concatenate([[force], np.zeros(3), upwards]))]).entities
        for force in (0.0, 10.0)
    )
    assert none.arrows == [] and len(some.arrows) == 1
    arrow = some.arrows[0]
    assert arrow.shaft_length == 0.05 and (some.timestamp.sec, some.timestamp.nsec) == (1, 500_000_000)
    turned = arrow.pose.orientation
    # x of the arrow, turned by the quaternion: the first column of its rotation.
    column = [
        1 - 2 * (turned.y**2 + turned.z**2),
        2 * (turned.x * turned.y + turned.w * turned.z),
        2 * (turned.x * turned.z - turned.w * turned.y),
    ]
    assert np.allclose(column, [0.0, 0.0, -1.0], atol=1e-4)


def read_messages(file: Path) -> dict[str, list[tuple[int, Any]]]:
    """Return the messages in JSON with their times, by topic, each checked with its schema."""
    found: dict[str, list[tuple[int, Any]]] = {}
    with file.open("rb") as content:
        for schema, channel, message in make_reader(content, validate_crcs=True).iter_messages():
            if channel.message_encoding != "json":
                continue
            assert schema is not None and schema.name.startswith("foxglove.") and b"$ref" not in schema.data
            value = json.loads(message.data)
            if channel.topic not in found:
                jsonschema.validate(value, json.loads(schema.data))
            found.setdefault(channel.topic, []).append((message.log_time, value))
    return found
