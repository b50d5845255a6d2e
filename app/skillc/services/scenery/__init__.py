"""Imports robot descriptions of other tools as scenery.

`reading` reads MJCF, URDF and SDF to solids; `sdf` translates SDF for MuJoCo; `writing` adds solids to a scene file.
"""
