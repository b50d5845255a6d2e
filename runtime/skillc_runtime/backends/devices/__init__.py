"""Drivers of devices that need no real time, such as grippers with a socket; back ends of real arms share them."""
