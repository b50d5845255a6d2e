"""From a goal to a validated plan. Start at `solve.solve`, or at `makespan.minimise` for plans with a short makespan.

`problem` makes the planning problem; `search`, `fast_downward` and `cp_sat` are the planners behind the protocols of
`plan` and `schedule`; `abstraction` handles large scenes; `validation` executes every plan in the world model.
"""
