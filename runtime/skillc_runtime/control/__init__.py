"""Drives arms: from what an arm measures and what it shall do to what it is commanded, once a control period.

Start with `driver.CompliantArmDriver.step`, then `arm_task` and the laws `impedance` and `forward_dynamics`.
"""
