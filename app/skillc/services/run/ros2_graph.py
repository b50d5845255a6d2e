"""Compares a scene with the topics and services that ROS 2 has now."""

from __future__ import annotations

from pathlib import Path

from skillc.errors import RequestError, ServiceError
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.stores import StoreChoice
from skillc.services.views.open_scenes import open_scene


def find_contradictions(scene: Path, reporter: Reporter) -> tuple[str, ...]:
    """Return a sentence for each contradiction; nothing is moved.

    RequestError if facts of the scene are missing, ServiceError if there is no ROS 2; errors as of `open_scene`.
    """
    from skillc_runtime.backends.ros2.graph_check import check_graph
    from skillc_runtime.devices.backend import BackendUnavailable
    from skillc_runtime.world.space.frame_tree import FrameError
    from skillc_runtime.world.state.data_sheet import SheetError

    try:
        with open_scene(scene, None, StoreChoice(), False, reporter) as opened:
            return tuple(check_graph(opened.state))
    except (SheetError, FrameError) as error:
        raise RequestError(str(error)) from error
    except BackendUnavailable as error:
        raise ServiceError(str(error)) from error
