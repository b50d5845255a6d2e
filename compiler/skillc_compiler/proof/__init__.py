"""Symbolic execution of compound bodies: what holds at each node for every way in which its children may end."""
