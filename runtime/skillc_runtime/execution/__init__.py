"""Runs tasks in a cell: selects implementations, turns plans into trees, ticks them, and replans what fails.

Start reading at `task_run`: `assignment` says what is to be done, `attempt` ticks one tree until it ends.
"""
