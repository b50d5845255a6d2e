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
    known = types.forms.get(condition)
    if known is None:
        known = types.forms[condition] = _canonical(types, condition)
    return known


def _canonical(types: AliasTypes, condition: Condition) -> Condition:
    match condition:
        case Holds(relation=relation) if types.is_written_out(relation):
            return _canonical(types, write_out(condition, types.vocabulary))
        case Holds(subject=subject, relation=relation, object=object_):
            name, turned = types.axioms.canonical.get(relation, (relation, False))
            return Holds(object_, name, subject) if turned else Holds(subject, name, object_)
        case Not(body=body):
            return Not(_canonical(types, body))
        case And(parts=parts):
            return And(tuple(_canonical(types, part) for part in parts))
        case Or(parts=parts):
            return Or(tuple(_canonical(types, part) for part in parts))
        case Same(left=Variable() | Individual() as left, right=Variable() | Individual() as right):
            return same_individual(left, right)
        case Compare():
            return _canonical_comparison(types, condition)
        case Exists() | Forall():
            return normalise_quantifier(types, condition, lambda body: _canonical(types, body))
    return condition


def _canonical_comparison(types: AliasTypes, asked: Compare) -> Condition:
    written = write_out_counts(asked, most=1)
    if written is not asked:
        return _canonical(types, written)
    if _is_constant(asked.left) and not _is_constant(asked.right):
        asked = Compare(asked.right, MIRRORED[asked.operator], asked.left)
    return map_children(asked, lambda side: _canonical_value(types, side))


def _canonical_value(types: AliasTypes, value: Expression) -> Expression:
    """Return a value with the conditions in it in their canonical forms."""
    if isinstance(value, Aggregate):
        where = _canonical(types, value.where)
        of_each = _canonical_value(types, value.value)
        depth = 1 + sum(isinstance(each, Aggregate) for part in (where, of_each) for each in walk(part))
        variable = Variable(f"{BOUND_PREFIX}each{depth}")
        named = {value.variable: variable}
        return replace(value, variable=variable.name, where=substitute(where, named), value=substitute(of_each, named))
    return map_children(value, lambda part: _canonical_value(types, part))


def _is_constant(expression: Expression) -> bool:
    return isinstance(expression, Literal)
