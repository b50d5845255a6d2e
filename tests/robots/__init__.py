"""Robots that others built, emulated at the level of their network protocols, and the back ends that drive them."""
