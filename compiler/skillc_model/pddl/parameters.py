"""The parameters of a skill in a plan: individuals become variables, other parameters keep their defaults."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from skillc_model.conditions import Condition, Expression
from skillc_model.pddl.formulas import Typed
from skillc_model.pddl.hierarchy import Hierarchy
from skillc_model.pddl.names import make_variable
from skillc_model.pddl.translate import BoundVariable, Untranslatable
from skillc_model.rewriting import decide_given, substitute
from skillc_model.skills import Parameter
from skillc_rdf.vocabulary.types import ClassType


class DefaultValues(msgspec.Struct, frozen=True):
    """The values of optional parameters in a plan: the default, or not given."""

    values: Mapping[str, Expression]
    given: Mapping[str, bool]

    def applied(self, condition: Condition) -> Condition:
        """Return the condition with the defaults substituted and every `given` decided."""
        return decide_given(substitute(condition, self.values), self.given)


def default_values(parameters: Sequence[Parameter]) -> DefaultValues:
    """Return the values of the optional parameters in a plan."""
    values = {each.name: each.default for each in parameters if each.direction == "opt" and each.default is not None}
    given = {each.name: each.direction != "opt" or each.default is not None for each in parameters}
    return DefaultValues(values, given)


def bind_parameters(parameters: Sequence[Parameter], hierarchy: Hierarchy) -> dict[str, BoundVariable]:
    """Return the variables a planner binds, by parameter; Untranslatable if one is not an individual."""
    places: dict[str, BoundVariable] = {}
    taken: set[str] = set()
    for parameter in parameters:
        if parameter.direction in ("opt", "out"):
            continue
        if not isinstance(parameter.type, ClassType):
            raise Untranslatable(f"its parameter `{parameter.name}` is no thing, so a planner cannot choose it")
        name = make_variable(parameter.name, taken)
        taken.add(name)
        places[parameter.name] = BoundVariable(Typed(name, hierarchy.type_name(parameter.type.iri)), parameter.type.iri)
    return places
