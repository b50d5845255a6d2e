"""The public Python API of `skillc`: handles of libraries, scenes, plans and runs; the services do the work.

Start at `running.start`, which all runs begin with, and at `operation.Operation`, which everybody commands.
"""
