"""Large scenes: plans with the near part first, then with more of it, and a lower bound from stand-ins for the rest.

Start at `stages.plan_in_stages`.
"""
