"""Control of arms: from measured state and reference to a command, once a control period.

Start with `driver.CompliantArmDriver.step`, then `arm_task` and the laws `impedance` and `forward_dynamics`.
"""
