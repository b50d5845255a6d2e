"""Cells in which tasks run: `mujoco` simulates one with physics, `kinematic` without; `simulation` is what both share.

Start with `mujoco.cell.SimulatedCell`. `real_time` runs either by the wall clock. `symbolic` is a world model alone.
Real robots are a package each.
"""
