"""From a goal and a version of the world to a planning problem: its objects, actions and facts.

Start at `pose.pose_problem`.
"""
