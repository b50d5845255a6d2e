"""Nested quantifiers as one block: variables, and a conjunction that some values of them must fulfil."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set

import msgspec

from skillc_model.conditions import And, Condition, Exists, Forall, Not, Or
from skillc_model.rewriting import map_children
from skillc_model.scopes import Nesting
from skillc_model.traversal import free_variables


class Block(msgspec.Struct, frozen=True):
    """There are individuals for the `variables` (name to class, in the order of the text) that fulfil all `parts`."""

    variables: Mapping[str, str]
    parts: tuple[Condition, ...]


def make_block(condition: Exists | Forall) -> Block:
    """Return the block that is equivalent to `exists`, or to the negation of `forall`.

    Quantifiers inside it join the block, unless their variable has the name of another one.
    """
    body = condition.body if isinstance(condition, Exists) else negate(condition.body)
    variables = {condition.variable: condition.cls}
    return Block(variables, tuple(_list_parts(body, variables, free_variables(condition))))


def narrow_scopes(condition: Condition) -> Condition:
    """Return an equivalent condition with all quantifiers in it moved inwards (see `scopes`)."""
    if not isinstance(condition, Exists | Forall):
        return map_children(condition, narrow_scopes) if isinstance(condition, Not | And | Or) else condition
    block = make_block(condition)
    parts = [(narrow_scopes(part), free_variables(part)) for part in block.parts]

    def quantify(name: str, body: Condition) -> Condition:
        return Exists(name, block.variables[name], body)

    nested = Nesting(parts, quantify, _join).nest(list(block.variables))
    return nested if isinstance(condition, Exists) else negate(nested)


def _join(parts: Sequence[Condition]) -> Condition:
    return parts[0] if len(parts) == 1 else And(tuple(parts))


def negate(condition: Condition) -> Condition:
    """Return the negation, with `not` moved inwards by one level."""
    match condition:
        case Not(body):
            return body
        case Or(parts):
            return And(tuple(map(negate, parts)))
        case And(parts):
            return Or(tuple(map(negate, parts)))
        case Exists(variable, cls, body):
            return Forall(variable, cls, negate(body))
        case Forall(variable, cls, body):
            return Exists(variable, cls, negate(body))
        case _:
            return Not(condition)


def _list_parts(condition: Condition, variables: dict[str, str], outer: Set[str]) -> Iterator[Condition]:
    """Yield the parts of a conjunction; add the variables of its quantifiers that join the block to `variables`."""
    match condition:
        case And(parts):
            for part in parts:
                yield from _list_parts(part, variables, outer)
        case Not(Not() | Or() | Forall() as body):
            yield from _list_parts(negate(body), variables, outer)
        case Exists(variable, cls, body) if variable not in variables and variable not in outer:
            variables[variable] = cls
            yield from _list_parts(body, variables, outer)
        case _:
            yield condition
