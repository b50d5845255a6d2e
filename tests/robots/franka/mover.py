"""Moves an arm to and fro until the process is ended: `python -m robots.franka.mover ADDRESS FOLDER`."""

from __future__ import annotations

import sys
from pathlib import Path

from robots.franka.cells import ARM, own_scene, real_cell


def main(address: str, folder: str) -> None:
    with real_cell(own_scene("sorting", "sort_parts", address, Path(folder))) as cell:
        arm = cell.arm(ARM)
        here, way = arm.measured.q.copy(), 0.4
        while True:
            arm.motion.move_joints(here + way, 0.2)
            print("moving", flush=True)
            while not arm.motion.done:
                cell.advance(0.05)
            way = -way


if __name__ == "__main__":
    main(*sys.argv[1:])
