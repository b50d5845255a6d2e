"""The simulated cell with the physics of MuJoCo.

Start with `cell`; `simulation` beside this package builds the model and the devices.
"""
