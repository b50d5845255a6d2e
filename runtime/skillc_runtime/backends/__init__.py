"""Cells in which tasks run: `mujoco` simulates one with physics, `kinematic` without; `simulation` is what both share.

Start with `mujoco.cell.SimulatedCell`. Other simulators or real robots are a package each.
"""
