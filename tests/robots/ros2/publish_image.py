"""A camera of ROS 2 in a process of its own: publishes a picture of a file and the lens, until it is ended."""

from __future__ import annotations

import sys
from time import sleep

import numpy as np

from skillc_runtime.backends.ros2.camera import IMAGE, INFO
from skillc_runtime.backends.ros2.session import Session, find_message
from skillc_runtime.vision.picture import read_image


def main(file: str, encoding: str, *lens: str) -> None:
    """Publish the picture in an encoding, below `/eye`; lens: focal lengths and principal point in pixels."""
    picture = read_image(file)
    pixels = np.ascontiguousarray(picture if encoding == "rgb8" else picture[:, :, ::-1])
    fx, fy, cx, cy = map(float, lens)
    session = Session("eye")
    images, infos = session.publish("/eye/image_raw", IMAGE, True), session.publish("/eye/camera_info", INFO, True)
    height, width = pixels.shape[:2]
    image = find_message(IMAGE)(encoding=encoding, width=width, height=height, step=3 * width, data=pixels.tobytes())
    info = find_message(INFO)(
        width=width,
        height=height,
        distortion_model="plumb_bob",
        d=[0.0] * 5,
        k=[fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
    )
    print("publishing", flush=True)
    while True:
        image.header.stamp = session.node.get_clock().now().to_msg()
        images.publish(image)
        infos.publish(info)
        sleep(0.1)


if __name__ == "__main__":
    main(*sys.argv[1:])
