"""An emulator of the controller of a UR5e: its network ports, its safety system, and a simulated arm in a scene behind.

It is written after public documents alone: Universal Robots' guides to RTDE, to the dashboard server and to the client
interfaces, the URScript manual, and the user manual of the e-Series for limits of the safety system. `python -m
robots.ur.emulator --help` starts it. It binds to one loopback address, all ports of a controller on it.
"""
