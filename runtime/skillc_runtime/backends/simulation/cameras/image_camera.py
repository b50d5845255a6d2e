"""A simulated camera that takes images: what it says of a surface or a part comes from pixels alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.simulation.cameras.image_camera_spec import ImageCameraSpec
from skillc_runtime.backends.simulation.cameras.image_inspection import ImageInspection, Photo, count_rim_pixels
from skillc_runtime.backends.simulation.cameras.light_drawn import draw_light
from skillc_runtime.backends.simulation.cameras.part_faces import draw_faces
from skillc_runtime.backends.simulation.cameras.photo_model import (
    add_camera,
    add_sheets,
    amounts_to_pixels,
    dirt_texture,
    face_texture,
    light_up,
)
from skillc_runtime.backends.simulation.cameras.photographer import (
    expose,
    find_pixels_of,
    render,
    require_rendering,
    set_offscreen,
)
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.devices.drawing import Drawing, Posture
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.vision.opencv import load_opencv
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.wrist_camera import FLANGE
from skillc_runtime.world.state.model import WorldModel

PIXELS_PER_CELL = 4
"""Pixels of the texture of dirt along each edge of a cell of 1 cm."""


class ImageCamera(ImageInspection):
    """Renders the cell with the dirt that is left on its surfaces, and inspects the image.

    Dirt falls by 1/e in each `removal_s` under a tool that is pressed on the surface enough to work. Lens, place, light
    and noise follow from the seed; only the renderer knows the dirt, and only the image leaves it. On the flange of an
    arm it is believed to be where the measured joints of the arm bring it.
    """

    def __init__(
        self, spec: ImageCameraSpec, drawing: Drawing, coverage: Mapping[str, CoverageMap], names: Mapping[str, str],
        world: WorldModel, seed: int, measure_joints: Callable[[str], Array],
    ) -> None:  # fmt: skip
        """RenderingError if nothing renders, ModuleNotFoundError without OpenCV.

        measure_joints: returns the joints (nv,) in rad that an arm, by IRI, measures now.
        """
        super().__init__(world)
        self._spec, self._drawing, self._coverage, self._names = spec, drawing, coverage, dict(names)
        self._seed, self._measure_joints = seed, measure_joints
        self._rng = rng_for(spec.individual, seed)
        wrong = self._rng.uniform(-1.0, 1.0, 6)
        moved = spec.pose.position + spec.mount_m * wrong[:3]
        self._true_mount = Pose(moved, exp(spec.mount_rad * wrong[3:]) @ spec.pose.rotation)
        self._light = draw_light(spec.individual, seed)
        self._before: dict[str, Array] = {}
        self.true_faces = draw_faces(spec.parts, seed)
        self._model = self._build()
        self._data: Any = mujoco.MjData(self._model)
        self._size = spec.lens.width, spec.lens.height
        require_rendering(self._size)

    def take_photo(self, looked_at: Pose, part: str = "") -> Photo:
        """Return an image of the cell as it is now, and what hides a plane at a pose in the world or a part, by IRI."""
        self._paint()
        self._place(self._drawing.posture())
        light = render(self._model, self._data, self._size)
        image = expose(light, self._light.colour, self._spec, self._rng)
        camera = self._believed_pose()
        return Photo(image, self._find_known(looked_at, part, camera), self._spec.lens, camera)

    def true_amounts(self, surface: str) -> Array:
        """Return how much dirt really is in the pixels (rows, columns) of a surface's texture, lowest row first."""
        dose, inspected = self._coverage[surface].dose, self._spec.surfaces[surface]
        columns, rows = (max(1, round(float(each) / 0.01)) * PIXELS_PER_CELL for each in inspected.size)
        if surface not in self._before:
            rng = rng_for(surface, self._seed, 3)
            coarse = rng.uniform(0.6, 1.0, (rows // 16 + 2, columns // 16 + 2)).astype(np.float32)
            cv2 = load_opencv()
            self._before[surface] = np.asarray(cv2.resize(coarse, (columns, rows), interpolation=cv2.INTER_CUBIC))
        picked = (np.arange(rows) * dose.shape[0]) // rows, (np.arange(columns) * dose.shape[1]) // columns
        rubbed = dose[picked[0]][:, picked[1]]
        left = np.where(self._coverage[surface].clean[picked[0]][:, picked[1]], 0.0, self._before[surface])
        return np.asarray(np.clip(left * np.exp(-rubbed / self._spec.removal_s[surface]), 0.0, 1.0))

    def _believed_pose(self) -> Pose:
        return self._find_camera(self._spec.arm, self._spec.pose, self._measure_joints)

    def _build(self) -> Any:
        described = self._drawing.describe_model()
        true = {each: self._coverage[each].world.inverse() for each in self._spec.surfaces}
        add_sheets(described, self._names, true, self._spec, PIXELS_PER_CELL)
        flange = None if self._spec.arm is None else part_name(self._names[self._spec.arm], FLANGE)
        add_camera(described, self._spec, self._true_mount, flange)
        state = self._world.snapshot()
        seen = [*(each.position for each in true.values()), *(pose(state, each).position for each in self.true_faces)]
        middle = np.mean(seen, axis=0) if seen else self._believed_pose().position
        sheets = [dirt_texture(self._names[each]) for each in true]
        sheets += [face_texture(self._names[each]) for each in self.true_faces]
        light_up(described, self._light, self._spec.ring_light, middle, sheets)
        model = described.compile()
        set_offscreen(model, (self._spec.lens.width, self._spec.lens.height))
        return model

    def _paint(self) -> None:
        for surface, inspected in self._spec.surfaces.items():
            pixels = amounts_to_pixels(self.true_amounts(surface), inspected.look)
            texture = self._model.texture(dirt_texture(self._names[surface])).id
            start = int(self._model.tex_adr[texture])
            self._model.tex_data[start : start + pixels.size] = pixels.ravel()

    def _place(self, posture: Posture) -> None:
        data = self._data
        data.qpos[:] = posture.joints
        data.mocap_pos[:], data.mocap_quat[:] = posture.base_positions, posture.base_quaternions
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_comPos(self._model, data)
        mujoco.mj_camlight(self._model, data)

    def _find_known(self, surface: Pose, part: str, camera: Pose) -> NDArray[np.bool_]:
        """Return which pixels (h, w) show known things that rise above a plane, at a pose in the world, with a rim.

        A part does not hide its own face. They are seen from where the `camera` is believed to be in the world; the rim
        is for its error. Arms measure their joints; what is not in the world model is not known.
        """
        model, things = self._model, self._drawing.individuals
        roots = {
            int(model.body(each.body).rootid[0])
            for thing, each in things.items()
            if each.kind != "surface" and thing != part
        }
        high = {
            int(model.body_rootid[model.geom_bodyid[each]]) for each in range(model.ngeom) if self._rises(each, surface)
        }
        known = {
            model.body(each).name for each in range(1, model.nbody) if int(model.body_rootid[each]) in roots & high
        }
        found = find_pixels_of(model, self._data, self._size, camera, known.__contains__)
        away = float(np.linalg.norm(surface.position - camera.position))
        rim = count_rim_pixels(self._spec.lens, self._spec.mount_m, self._spec.mount_rad, away)
        kernel = np.ones((2 * rim + 1,) * 2, dtype=np.uint8)
        return np.asarray(load_opencv().dilate(found.astype(np.uint8), kernel) > 0)

    def _rises(self, geom: int, surface: Pose) -> bool:
        """Whether a geom is partly above the plane of a surface, which is given in the world."""
        rotation, middle, half = self._data.geom_xmat[geom].reshape(3, 3), *np.split(self._model.geom_aabb[geom], 2)
        centre = self._data.geom_xpos[geom] + rotation @ middle
        normal = surface.rotation[:, 2]
        return bool(normal @ (centre - surface.position) + np.abs(normal @ rotation) @ half > 0)
