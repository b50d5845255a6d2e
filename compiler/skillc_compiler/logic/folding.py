"""Computes what is constant in expressions and conditions."""

from __future__ import annotations

import msgspec

from skillc_compiler.library.conditions import (
    And,
    Arithmetic,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Invoke,
    Literal,
    Not,
    Or,
    PropertyOf,
)
from skillc_dsl import syntax as s

MOST_ROUNDS = 1_000_000
"""More rounds than that count as endless."""


def fold(expression: Expression) -> Expression:
    """Return the expression with arithmetic on constants carried out; a division by zero stays as it is."""
    match expression:
        case Arithmetic(operator=operator, left=left, right=right):
            return _arithmetic(Arithmetic(operator, fold(left), fold(right)))
        case PropertyOf(of=of, property=name):
            return PropertyOf(fold(of), name)
        case Invoke(function=function, arguments=arguments):
            return Invoke(function, tuple(fold(argument) for argument in arguments))
    return expression


def fold_condition(condition: Condition) -> Condition:
    """Return the condition with the arithmetic in it folded."""
    match condition:
        case Compare(left=left, operator=operator, right=right):
            return Compare(fold(left), operator, fold(right))
        case Not(body=body):
            return Not(fold_condition(body))
        case And(parts=parts):
            return And(tuple(fold_condition(part) for part in parts))
        case Or(parts=parts):
            return Or(tuple(fold_condition(part) for part in parts))
        case Exists(body=body) | Forall(body=body):
            return msgspec.structs.replace(condition, body=fold_condition(body))
    return condition


def number(expression: Expression | None) -> float | None:
    """Return the number that an expression is, None if it is not a constant number."""
    match fold(expression) if expression is not None else None:
        case Literal(value=bool()):
            return None
        case Literal(value=int() | float() as value):
            return float(value)
    return None


def _arithmetic(expression: Arithmetic) -> Expression:
    left, right = number(expression.left), number(expression.right)
    if left is None or right is None:
        return expression
    match expression.operator:
        case "+":
            return Literal(left + right)
        case "-":
            return Literal(left - right)
        case "*":
            return Literal(left * right)
        case "/":
            return Literal(left / right) if right else expression


def rounds_of(written: s.Number) -> int:
    """Return a number of rounds as a whole number that there can be; any other is reported as `bad-count`."""
    return int(min(max(written.value, 1), MOST_ROUNDS))
