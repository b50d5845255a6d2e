"""Images and lenses of ROS 2 become those of the vision; what is not read is said."""

from types import SimpleNamespace

import numpy as np
import pytest

from skillc_runtime.backends.ros2.image_inspection import decode_image, read_info
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.vision.lens import Lens

RED_BLUE = np.array([[[200, 10, 30], [1, 2, 3]]], dtype=np.uint8)
"""Red, green and blue of a picture of two pixels."""


@pytest.mark.parametrize(
    ("encoding", "pixels"),
    [
        ("rgb8", RED_BLUE),
        ("bgr8", RED_BLUE[:, :, ::-1]),
        ("rgba8", np.dstack([RED_BLUE, np.full((1, 2), 255, np.uint8)])),
        ("bgra8", np.dstack([RED_BLUE[:, :, ::-1], np.full((1, 2), 255, np.uint8)])),
    ],
)
def test_an_image_has_red_green_and_blue_whatever_its_encoding(encoding: str, pixels: np.ndarray) -> None:
    padded = pixels.tobytes() + b"\0\0"
    image = SimpleNamespace(encoding=encoding, width=2, height=1, step=len(padded), data=padded)
    assert (decode_image(image) == RED_BLUE).all()


def test_what_is_not_read_is_named() -> None:
    with pytest.raises(NoSuchDevice, match="the encoding 'bayer_rggb8'; these are read: rgb8, bgr8"):
        decode_image(SimpleNamespace(encoding="bayer_rggb8"))
    with pytest.raises(NoSuchDevice, match="the distortion 'equidistant'"):
        read_info(SimpleNamespace(distortion_model="equidistant"))
    k = (820.0, 0.0, 322.0, 0.0, 818.0, 238.0, 0.0, 0.0, 1.0)
    info = SimpleNamespace(distortion_model="plumb_bob", width=640, height=480, k=k, d=(-0.1, 0.02, 0.0, 0.0))
    assert read_info(info) == Lens(640, 480, 820.0, 818.0, 322.0, 238.0, (-0.1, 0.02, 0.0, 0.0))
