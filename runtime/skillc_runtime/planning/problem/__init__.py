"""From a goal and a version of the world to a planning problem: which objects, actions and facts it has.

Start at `pose.pose_problem`.
"""
