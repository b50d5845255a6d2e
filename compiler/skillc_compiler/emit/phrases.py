"""Values and expressions in the words of the language; quantities in SI units, which the language reads too."""

from __future__ import annotations

from typing import assert_never

from skillc_compiler.library.conditions import (
    Arithmetic,
    Expression,
    Individual,
    Invoke,
    Literal,
    PropertyOf,
    Variable,
)
from skillc_compiler.library.vocabulary import Vocabulary, local_name


def literal_text(value: bool | int | float | str) -> str:
    """Return a constant as plain text."""
    match value:
        case bool():
            return "true" if value else "false"
        case int() | float():
            return f"{value:.12g}"
        case str():
            return value
        case _:
            assert_never(value)


def expression_text(expression: Expression, vocabulary: Vocabulary) -> str:
    """Return the expression as it could be written in a skill, with as many parentheses as it needs."""
    match expression:
        case Literal(value=str() as text):
            return f'"{text}"'
        case Literal(value=value):
            return literal_text(value)
        case Variable(name=name):
            return name
        case Individual(iri=iri):
            return vocabulary.short(iri)
        case PropertyOf(of=of, property=iri):
            return f"{expression_text(of, vocabulary)}.{local_name(iri)}"
        case Arithmetic(operator=operator, left=left, right=right):
            return f"{_operand(left, vocabulary)} {operator} {_operand(right, vocabulary)}"
        case Invoke(function=function, arguments=arguments):
            return f"{function}({', '.join(expression_text(each, vocabulary) for each in arguments)})"
        case _:
            assert_never(expression)


def _operand(expression: Expression, vocabulary: Vocabulary) -> str:
    text = expression_text(expression, vocabulary)
    return f"({text})" if isinstance(expression, Arithmetic) else text
