"""The back end for the Franka Control Interface, against a robot that others simulate."""
