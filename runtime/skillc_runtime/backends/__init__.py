"""Cells that tasks run in: `mujoco` simulates one in lock step. Another simulator or real robots are a package each.

Start at `mujoco.cell.SimulatedCell`.
"""
