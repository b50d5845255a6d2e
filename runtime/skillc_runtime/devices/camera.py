"""The interface of a camera that estimates the poses of objects, simulated or real."""

from __future__ import annotations

from typing import Protocol

import msgspec

from skillc_runtime.motion.pose import Array, Pose


class PoseEstimate(msgspec.Struct, frozen=True):
    """The pose of an object in the frame of a camera, from the image that was taken at `taken_s` of its clock.

    position_m, angle_rad: the standard deviations along and about each axis that the camera states.
    """

    pose: Pose
    taken_s: float
    position_m: float
    angle_rad: float


class PoseCamera(Protocol):
    """A camera with an estimator. It takes images of its own accord, and may miss an object or see it elsewhere."""

    @property
    def clock_s(self) -> float:
        """The present time in s of the clock by which the camera dates its images."""
        ...

    def locate(self, thing: str, since_s: float) -> PoseEstimate | None:
        """Return the newest estimate of an object, by IRI, from images taken at `since_s` or later.

        None as long as no such image has arrived in which the object was found.
        """
        ...

    def depth_m(self, towards: Array) -> float | None:
        """Return how far away the first thing is on the ray towards a point (3,) in m in the frame of the camera, in m.

        Infinite if there is nothing; None if the point is out of view, or no image arrives.
        """
        ...
