"""The back end for arms that are controlled through the Franka Control Interface."""
