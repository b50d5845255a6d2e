"""Pictures show what is there, and nothing that only programs need."""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np
import pytest

from skillc_runtime.film.camera import CameraView
from skillc_runtime.film.rendering import Renderer, RenderingError

BALL = '<mujoco><worldbody><{kind} type="sphere" size="0.5" rgba="1 0 0 1"/></worldbody></mujoco>'


@pytest.fixture(params=["geom", "site"])
def seen(request: pytest.FixtureRequest) -> Iterator[tuple[str, np.ndarray]]:
    """A kind of ball, and the picture of a red one."""
    model = mujoco.MjModel.from_xml_string(BALL.format(kind=request.param))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    try:
        renderer = Renderer(model, 32, 32)
    except RenderingError as missing:
        pytest.skip(str(missing))
    yield request.param, renderer.picture(data, CameraView(np.zeros(3), 2.0, 0.0, 0.0))
    renderer.close()


def test_bodies_are_drawn_and_the_names_of_places_are_not(seen: tuple[str, np.ndarray]) -> None:
    kind, picture = seen
    assert (picture[16, 16, 0] > 50) == (kind == "geom")
