"""Makes messages of the samples of a cell: its signals, and pictures of it for Foxglove."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec
import numpy as np

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.recording.mcap.contents import SIGNALS
from skillc_runtime.recording.mcap.foxglove import FIXED, FORCES, MOVING, SCENE, ScenePicture, describe_forces
from skillc_runtime.recording.mcap.foxglove_types import FrameTransforms, SceneUpdate
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.signal_block import SignalBlock, encode_columns
from skillc_runtime.recording.mcap.signal_tap import RecordedCell

PICTURES: Mapping[type[msgspec.Struct], tuple[str, ...]] = {
    FrameTransforms: (FIXED, MOVING),
    SceneUpdate: (SCENE, FORCES),
}
"""The topics of pictures, by the type of their messages."""

Message = tuple[str, int, msgspec.Struct]
"""A topic, the time of the cell in ns, and what is said."""


class SampleMessages:
    """Makes the messages of blocks of samples, one after the other."""

    def __init__(self, cell: RecordedCell) -> None:
        self._layout = cell.tap.layout
        self._picture = None if cell.model is None else ScenePicture(cell.model)
        self._units = tuple(each.unit for each in cell.signals)
        self._is_shown = False

    def make(self, block: SampledBlock) -> Iterator[Message]:
        """Yield the messages of the next block."""
        first_ns = round(block.first_s * 1e9)
        columns = encode_columns(self._layout.rows_of(block), self._units)
        yield SIGNALS, first_ns, SignalBlock(first_ns, self._layout.period_ns, block.rows, columns)
        faces = tuple(self._layout.faces_of(block))
        if self._picture is None:
            return
        if not block.poses:
            return
        times_s, *places = zip(*block.poses, strict=True)
        positions, quaternions = (np.frombuffer(b"".join(each)) for each in places)
        count = len(times_s)
        where = positions.reshape(count, -1, 3), quaternions.reshape(count, -1, 4)
        if not self._is_shown:
            self._is_shown, moment = True, round(times_s[0] * 1e9)
            yield SCENE, moment, self._picture.shapes(times_s[0])
            yield FIXED, moment, self._picture.fixed_frames(times_s[0], where[0][0], where[1][0])
        for time_s, frames in zip(times_s, self._picture.moving_frames(times_s, *where), strict=True):
            moment = round(time_s * 1e9)
            yield MOVING, moment, frames
            row = min((moment - first_ns) // self._layout.period_ns, block.rows - 1)
            yield FORCES, moment, describe_forces(time_s, [(local_name(tool), face[row]) for tool, face in faces])
