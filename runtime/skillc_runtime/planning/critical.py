"""The critical path: how long reaching the goal takes if all that can run at once does, and nothing is ever lost."""

from __future__ import annotations

import time

from skillc_compiler.library.pddl.problem import Problem
from skillc_runtime.planning.grounding import Grounding, TimeIsUp
from skillc_runtime.planning.relaxed import Estimate


def critical_path_s(problem: Problem, deadline_s: float) -> float:
    """Return a time in seconds that every plan takes: infinity where there is none, 0 where looking takes too long.

    An atom can be true when the longest of the conditions of an action has become so, and the action is over: the
    estimate h-max with durations for costs. Haslum and Geffner, "Heuristic planning with time and resources", 2001.
    """
    grounding = Grounding(problem, time.monotonic() + deadline_s)
    try:
        actions, goal = grounding.actions, grounding.goal()
    except TimeIsUp:
        return 0.0
    atoms = sorted(grounding.reachable, key=lambda each: (each.predicate, each.terms))
    numbers = {atom: number for number, atom in enumerate(atoms)}
    start = sum(1 << numbers[atom] for atom in grounding.init)
    return Estimate(actions, goal, numbers)(start) / float(problem.domain.scale)
