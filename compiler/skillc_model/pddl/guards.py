"""Conditions on facts that no skill changes, as static predicates that are evaluated when the problem is built."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field

from skillc_model.conditions import Condition
from skillc_model.pddl.domain import GuardMeaning, Predicate
from skillc_model.pddl.formulas import Atom, Formula
from skillc_model.pddl.kebab import to_kebab
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.symbols import Symbols
from skillc_model.pddl.translate import Scope, StaticEvaluator, Untranslatable
from skillc_model.read_write import terms_read
from skillc_model.rewriting import is_plain_fact
from skillc_model.traversal import free_variables_in_order


@dataclass
class Guards:
    """Collects the guards of one skill; `taken` are names already in use.

    A condition gets one guard per combination of parameter types, evaluated for the objects of these types only.
    """

    skill: str
    symbols: Symbols
    taken: Collection[str]
    found: dict[tuple[Condition, tuple[str, ...]], Predicate] = field(default_factory=dict)

    def labelled(self, label: str, text: str) -> StaticEvaluator:
        """Return an evaluator that makes guards from parts of the condition with this label and source text."""

        def evaluate(condition: Condition, scope: Scope) -> Formula | None:
            kept = is_plain_fact(condition) and not any(map(self.symbols.is_computed, terms_read(condition)))
            return None if kept else self._guard(label, text, condition, scope)

        return evaluate

    def _guard(self, label: str, text: str, condition: Condition, scope: Scope) -> Atom:
        variables = free_variables_in_order(condition)
        for name in variables:
            if name not in scope:
                raise Untranslatable(f"reads `{name}`, which a planner does not bind")
        places = [scope[name].variable for name in variables]
        key = condition, tuple(each.type for each in places)
        if key not in self.found:
            used = {*self.taken, *(each.name for each in self.found.values())}
            name = make_unique(f"guard-{to_kebab(self.skill)}-{to_kebab(label)}", used)
            meaning = GuardMeaning(variables, condition, self.skill, label, text)
            self.found[key] = Predicate(name, tuple(places), meaning, False)
        return Atom(self.found[key].name, tuple(each.name for each in places))
