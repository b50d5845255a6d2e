"""Devices that need no real time, as several back ends use them: grippers, inputs and outputs."""
