"""Grasps: how a hand takes a body, and whether it carries it."""
