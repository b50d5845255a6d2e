"""A library as a planning domain, a scene and a goal as a planning problem, and both as PDDL text.

Start at `planning.make_planning_domain`.
"""
