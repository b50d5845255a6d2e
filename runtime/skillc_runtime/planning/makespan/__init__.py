"""Plans with a short makespan: steps scheduled in parallel, simulated, and compared with a lower bound.

Start reading at `minimise`.
"""
