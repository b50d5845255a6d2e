"""Whether a goal can be reached at all from a world, without searching for a plan."""

from __future__ import annotations

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.pddl.formulas import FALSE, conjuncts
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.diagnose import why_unsolvable
from skillc_runtime.planning.grounding import Grounding
from skillc_runtime.planning.problem import GoalError, pose_problem
from skillc_runtime.world.state import WorldState


def why_unreachable(library: SkillLibrary, state: WorldState, goal: Condition) -> str | None:
    """Return why no plan can reach the goal even if nothing once true were ever lost; None if one may."""
    try:
        posed = pose_problem(library, state, goal)
    except GoalError as error:
        return str(error)
    grounding = Grounding(posed.problem)
    grounding.explore()
    wanted = grounding.goal()
    if wanted != FALSE and all(grounding.possible(part) for part in conjuncts(wanted)):
        return None
    return why_unsolvable(posed, goal, state)
