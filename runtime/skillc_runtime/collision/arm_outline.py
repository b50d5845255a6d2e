"""Finds which pixels of an image may show an arm, from its measured joints; nothing is rendered."""

from __future__ import annotations

from itertools import product

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.collision.arm_assembly import ArmAssembly
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.scenery import Scenery, pose_key
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.opencv import load_opencv

CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))

NEAR_M = 0.02
"""What is nearer to the plane of the lens is drawn as if it were so far away: it is seen at most there."""

FAR_BELOW = Scenery(pose_key(Pose.of((0.0, 0.0, -100.0))), (), ())
"""No scenery: only the arm is drawn."""


def find_arm_pixels(assembly: ArmAssembly, q: Array, base: Pose, lens: Lens) -> NDArray[np.bool_]:
    """Return the pixels (h, w) within the outlines of the boxes around the parts of an arm, and of what it holds.

    q: (nv,) in rad, its joints. base: its pose in the frame of the camera. The distortion of the lens is left out: the
    boxes are larger than the parts.
    """
    model = build_collision_model(assembly, FAR_BELOW)
    compiled = model.compiled
    data, image, cv2 = mujoco.MjData(compiled), np.zeros((lens.height, lens.width), dtype=np.uint8), load_opencv()
    data.qpos[: model.joints], data.qpos[model.joints :] = q, model.fingers
    mujoco.mj_kinematics(compiled, data)
    for geom in range(compiled.ngeom):
        if compiled.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            continue
        middle, half = np.split(compiled.geom_aabb[geom], 2)
        at = base @ Pose(data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3))
        seen = (middle + CORNERS * half) @ at.rotation.T + at.position
        if (seen[:, 2] <= 0.0).all():
            continue
        depth = np.maximum(seen[:, 2], NEAR_M)
        pixels = np.stack([lens.fx * seen[:, 0] / depth + lens.cx, lens.fy * seen[:, 1] / depth + lens.cy], axis=1)
        hull = cv2.convexHull(np.rint(np.clip(pixels, -1e4, 1e4)).astype(np.int32))
        cv2.fillConvexPoly(image, hull, 1)
    return np.asarray(image > 0)
