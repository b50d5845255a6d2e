"""The back end for Universal Robots, against an emulated controller."""
