"""The names in the scope of a quantifier, with what is known of the quantified conditions inside it."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import TypeAlias

from skillc_model.conditions import Condition, Exists, Forall
from skillc_model.traversal import free_variables_in_order, walk
from skillc_runtime.world.eval.bindings import Bindings
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

ConditionTest: TypeAlias = Callable[[WorldState, Bindings], bool]


class Scope(dict[str, "Value | None"]):
    """Values by name; `known` are the results of quantified conditions inside, for one version of the world.

    A condition is evaluated once for all values of the variables that it does not read, so that the time does not grow
    with the depth to which quantifiers are nested, but with the variables that are needed at the same time.
    """

    __slots__ = ("known",)
    known: dict[Hashable, bool]

    @staticmethod
    def inside(bindings: Bindings) -> Scope:
        """Return a scope for further names."""
        scope = Scope(bindings)
        scope.known = bindings.known if isinstance(bindings, Scope) else {}
        return scope


def contains_quantifier(condition: Condition) -> bool:
    """Whether there is a quantifier in a condition."""
    return any(isinstance(each, Exists | Forall) for each in walk(condition))


def remember(condition: Exists | Forall, test: ConditionTest) -> ConditionTest:
    """Return the test with its results remembered while it is evaluated inside of another quantifier."""
    names = free_variables_in_order(condition)

    def remembering(state: WorldState, bindings: Bindings) -> bool:
        if not isinstance(bindings, Scope):
            return test(state, bindings)
        # Only individuals change inside of a scope; other values are compared by identity, since some have no hash.
        values = (bindings.get(name) for name in names)
        key = (id(remembering), *(each if isinstance(each, str) else id(each) for each in values))
        found = bindings.known.get(key)
        if found is None:
            found = bindings.known[key] = test(state, bindings)
        return found

    return remembering
