"""The names of the things around the simulated robot, and where their button switches."""

DESK, FACE = "Desk-1", "face"
SWITCHES_M = 0.003
