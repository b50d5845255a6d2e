"""Planning in large scenes: with the part near the goal, then with larger parts, and lower bounds for the whole.

Start at `stages.plan_in_stages`.
"""
