"""Protocols and values of devices: arms, grippers, bases, sensors and their cell, simulated or real.

Start with `cell`, then `arm` (read and commanded once a control period) and `arm_driver` (the interface for skills).
"""
