"""Simulated arms: motors, sensors, friction, brakes, and the line to their controller."""
