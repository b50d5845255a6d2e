"""Random libraries: planners, the PDDL that is written for others, and trying everything agree."""
