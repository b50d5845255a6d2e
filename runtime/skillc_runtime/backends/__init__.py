"""Cells in which tasks run: `mujoco` simulates one with physics; `simulation` is what simulated cells share.

Start with `mujoco.cell.SimulatedCell`. Other simulators or real robots are a package each.
"""
