"""Protocols and values of devices: arms, grippers, bases, sensors and the cell that has them, simulated or real.

Start with `cell`, then `arm` (what is read and commanded once a control period) and `arm_driver` (what skills see).
"""
