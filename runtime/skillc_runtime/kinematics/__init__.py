"""Kinematics of an arm as functions of arrays, fast enough for thousands of postures: no simulator, no world model.

Start with `chain`; `inverse` finds all postures of a pose, `sweep` follows a path of poses with a force.
"""
