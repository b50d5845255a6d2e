"""Reads the model of an arm from URDF or MJCF, and writes its data sheet and model for a project.

Start at `add_robot`: a file is read as a `RobotModel`, which is written as MJCF, compared with the file, and described
by a sheet.
"""
