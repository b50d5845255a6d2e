"""The built-in planner: grounding, the heuristic h-max, and A*.

Start at `astar.AStar`.
"""
