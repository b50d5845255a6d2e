"""Cells in which tasks run: `mujoco` simulates one in lock step; other simulators or real robots are a package each.

Start with `mujoco.cell.SimulatedCell`.
"""
