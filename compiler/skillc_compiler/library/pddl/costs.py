"""What an action costs: its expected duration, in integer units, as Fast Downward wants it."""

from __future__ import annotations

from collections.abc import Collection

from skillc_compiler.library.conditions import Expression
from skillc_compiler.library.pddl.domain import ComputedCost, Cost, CostFunction, FixedCost
from skillc_compiler.library.pddl.names import fresh, kebab
from skillc_compiler.library.pddl.parameters import Defaults
from skillc_compiler.library.pddl.rewriting import constant, replaced
from skillc_compiler.library.pddl.translate import Scope, Untranslatable
from skillc_compiler.library.reading import free_variables_in_order
from skillc_compiler.library.skills import Skill

UNITS_PER_SECOND = 10.0
ASSUMED_SECONDS = 1.0


def units(seconds: float) -> int:
    """Return a duration as a cost: whole tenths of a second, at least one."""
    return max(1, round(seconds * UNITS_PER_SECOND))


def action_cost(
    skill: Skill, defaults: Defaults, scope: Scope, taken: Collection[str]
) -> tuple[Cost, CostFunction | None]:
    """Return the cost of a skill, with its function when it depends on the things; unsaid, it is taken for a second.

    The function is evaluated once, in the initial world.
    """
    if skill.duration is None:
        return FixedCost(units(ASSUMED_SECONDS)), None
    duration: Expression = replaced(skill.duration, defaults.values)
    seconds = constant(duration)
    if seconds is not None:
        return FixedCost(units(seconds)), None
    variables = free_variables_in_order(duration)
    for name in variables:
        if name not in scope:
            raise Untranslatable(f"its duration reads `{name}`, which a planner does not bind")
    places = tuple(scope[name].variable for name in variables)
    name = fresh(f"cost-{kebab(skill.name)}", taken)
    function = CostFunction(name, places, variables, duration, skill.name)
    return ComputedCost(name, tuple(each.name for each in places)), function
