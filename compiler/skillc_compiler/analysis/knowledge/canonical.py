"""The canonical form of conditions: one name for each individual and relation, one form for what means the same."""

from __future__ import annotations

from msgspec.structs import replace

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, same_individual
from skillc_compiler.analysis.knowledge.quantifiers import BOUND_PREFIX, normalise_quantifier
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.logic.bounds import MIRRORED
from skillc_model.conditions import (
    Aggregate,
    And,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Holds,
    Individual,
    Literal,
    Not,
    Or,
    Same,
    Variable,
)
from skillc_model.counting import write_out_counts
from skillc_model.definitions import write_out
from skillc_model.rewriting import map_children, substitute
from skillc_model.traversal import walk


def canonical_condition(types: AliasTypes, state: State, condition: Condition) -> Condition:
    """Return the canonical form of a condition: one name for each individual and each relation."""
    if state.aliases:
        condition = substitute(condition, state.aliases)
    match condition:
        case Holds(relation=relation) if types.is_written_out(relation):
            return canonical_condition(types, state, write_out(condition, types.vocabulary))
        case Holds(subject=subject, relation=relation, object=object_):
            name, turned = types.axioms.canonical.get(relation, (relation, False))
            return Holds(object_, name, subject) if turned else Holds(subject, name, object_)
        case Not(body=body):
            return Not(canonical_condition(types, state, body))
        case And(parts=parts):
            return And(tuple(canonical_condition(types, state, part) for part in parts))
        case Or(parts=parts):
            return Or(tuple(canonical_condition(types, state, part) for part in parts))
        case Same(left=Variable() | Individual() as left, right=Variable() | Individual() as right):
            return same_individual(left, right)
        case Compare():
            return _canonical_comparison(types, state, condition)
        case Exists() | Forall():
            return normalise_quantifier(types, condition, lambda body: canonical_condition(types, state, body))
    return condition


def _canonical_comparison(types: AliasTypes, state: State, asked: Compare) -> Condition:
    written = write_out_counts(asked, most=1)
    if written is not asked:
        return canonical_condition(types, state, written)
    if _is_constant(asked.left) and not _is_constant(asked.right):
        asked = Compare(asked.right, MIRRORED[asked.operator], asked.left)
    return map_children(asked, lambda side: _canonical_value(types, state, side))


def _canonical_value(types: AliasTypes, state: State, value: Expression) -> Expression:
    """Return a value with the conditions in it in their canonical forms."""
    if isinstance(value, Aggregate):
        where = canonical_condition(types, state, value.where)
        of_each = _canonical_value(types, state, value.value)
        depth = 1 + sum(isinstance(each, Aggregate) for part in (where, of_each) for each in walk(part))
        variable = Variable(f"{BOUND_PREFIX}each{depth}")
        named = {value.variable: variable}
        return replace(value, variable=variable.name, where=substitute(where, named), value=substitute(of_each, named))
    return map_children(value, lambda part: _canonical_value(types, state, part))


def _is_constant(expression: Expression) -> bool:
    return isinstance(expression, Literal)
