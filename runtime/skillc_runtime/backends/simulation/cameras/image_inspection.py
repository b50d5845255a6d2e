"""Inspects surfaces and parts by images, of a renderer or of a real camera: what it says comes from pixels alone."""

from __future__ import annotations

from collections.abc import Callable

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.motion.dirt_map import DirtMap
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.cell_map import CellMap
from skillc_runtime.vision.classify_part import ClassifiedPart, classify_part
from skillc_runtime.vision.inspect_image import inspect_image
from skillc_runtime.vision.label_pose import NotDecided
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.locate import NotLocated
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.image_facts import MARKER_SIZE, read_inspected
from skillc_runtime.world.space.part_looks import face_of, read_looks
from skillc_runtime.world.space.wrist_camera import read_flange
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import SURFACE


class Photo(msgspec.Struct, frozen=True):
    """An image (h, w, 3), which of its pixels (h, w) show known things, the lens, the believed pose of the camera."""

    image: NDArray[np.uint8]
    hidden: NDArray[np.bool_]
    lens: Lens
    camera: Pose


class ImageInspection(Camera):
    """A camera that takes images, and inspects them; a subclass takes them."""

    def __init__(self, world: WorldModel) -> None:
        self._world = world
        self._seen: dict[str, CellMap] = {}

    def take_photo(self, looked_at: Pose, part: str = "") -> Photo:
        """Return an image of the cell as it is now, and what hides a plane at a pose in the world or a part, by IRI.

        NoSuchDevice if none is taken.
        """
        raise NotImplementedError

    def inspect(self, surface: str) -> float:
        """Return the share of a surface that an image shows to be clean; NoSuchDevice if the image does not decide."""
        self._seen[surface] = self.look(surface)
        return self._seen[surface].clean_share

    def dirt_map(self, surface: str) -> DirtMap | None:
        """Return which cells of a surface the last inspection showed clean, dirty or not at all."""
        return self._seen[surface].dirt_map if surface in self._seen else None

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Raise NoSuchDevice: no image shows that."""
        raise NoSuchDevice("an image does not show how long the places of a surface were rubbed")

    def look(self, surface: str) -> CellMap:
        """Return what an image that is taken now shows of a surface, by IRI; NoSuchDevice if it is not found there."""
        state = self._world.snapshot()
        if not state.is_a(surface, SURFACE):
            raise KeyError(surface)
        short, at = state.vocabulary.short(surface), pose(state, surface)
        if state.value(surface, MARKER_SIZE) is None:
            raise NoSuchDevice(f"{short} has no markers, without which no image is judged: state skillc:markerSize")
        photo = self.take_photo(at)
        believed = photo.camera.inverse() @ at
        try:
            return inspect_image(photo.image, photo.lens, read_inspected(state, surface), believed, photo.hidden)
        except NotLocated as error:
            raise NoSuchDevice(f"the image does not show where {short} is: {error}") from error

    def classify(self, part: str) -> ClassifiedPart:
        """Return what an image that is taken now shows of a part, by IRI; NoSuchDevice if it does not decide."""
        state = self._world.snapshot()
        looks, face = read_looks(state, part), face_of(state, part)
        photo = self.take_photo(face, part)
        try:
            return classify_part(photo.image, photo.lens, looks, photo.camera.inverse() @ face, photo.hidden)
        except NotDecided as error:
            short = state.vocabulary.short
            raise NoSuchDevice(f"the image does not show what {short(part)} is: {error}") from error

    def _find_camera(self, arm: str | None, stated: Pose, measure_joints: Callable[[str], Array]) -> Pose:
        """Return where the camera is believed to be in the world: where it is stated to be there, or on a flange.

        arm: on whose flange it is, by IRI. measure_joints: returns the joints (nv,) in rad that an arm measures now.
        """
        if arm is None:
            return stated
        state = self._world.snapshot()
        return pose(state, arm) @ read_flange(state, arm).place_tool(measure_joints(arm)) @ stated


def count_rim_pixels(lens: Lens, mount_m: float, mount_rad: float, away_m: float) -> int:
    """Return how many pixels something at a distance may be elsewhere, as the camera is up to so much off."""
    return 1 + int(np.ceil(lens.fx * (mount_rad + 2 * mount_m / away_m)))
