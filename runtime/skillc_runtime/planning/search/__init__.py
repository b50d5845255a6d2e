"""The built-in search: grounding, the estimate h-max, A*, and lower bounds on the time of any plan.

Start at `astar.AStar`.
"""
