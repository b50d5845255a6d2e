"""The ports of skills, and what is written for them in a call.

BehaviorTree.CPP refuses a call of a tree that does not map each port of its model that has no default. So a tree
declares what every caller passes or takes, and what has a default; the rest may be mapped, but need not be.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.emit.bt_model import Direction, Port
from skillc_compiler.emit.bt_names import given, port
from skillc_compiler.emit.phrases import literal_text
from skillc_compiler.library.conditions import Expression, Individual, Literal, Variable
from skillc_compiler.library.pddl.rewriting import constant
from skillc_compiler.library.skills import Parameter
from skillc_compiler.library.vocabulary import (
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
)

PLAIN = {"Bool": "bool", "Int": "int", "Text": "std::string", "Pose": None}
NOT_TAKEN_AS_WRITTEN = ("{", "json:")


def action_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a single action on values that are there already."""
    return tuple(_port(each) for each in parameters)


def whole_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a node that stands for a whole skill and infers what it is not given."""
    return tuple(_given(each) if each.direction == "infer" else _port(each) for each in parameters)


def inferring_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of an action that finds the inferred parameters, except those that are given."""
    inferred = [each for each in parameters if each.direction == "infer"]
    return (*whole_ports(parameters), *(_port(each, "output") for each in inferred))


def tree_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a skill that is a tree: what is required, what has a default, and the outputs."""
    return tuple(_port(each) for each in parameters if each.direction in ("in", "out") or default_text(each))


def called(parameter: Parameter) -> str:
    """Return the port through which a caller passes a parameter."""
    return given(parameter.name) if parameter.direction == "infer" else port(parameter.name)


def defaults(parameters: Sequence[Parameter]) -> dict[str, str]:
    """Return the attributes that give every parameter with a default its default."""
    texts = ((port(each.name), default_text(each)) for each in parameters)
    return {name: text for name, text in texts if text}


def passed_on(parameters: Sequence[Parameter]) -> dict[str, str]:
    """Return the attributes that map each parameter to the entry of its name."""
    return {port(each.name): f"{{{port(each.name)}}}" for each in parameters}


def default_text(parameter: Parameter) -> str | None:
    """Return the default as a port has it, None without; the empty text counts as none in BehaviorTree.CPP."""
    match parameter.default:
        case None:
            return None
        case Literal() | Individual() as value:
            return plain_value(value)
        case computed:
            number = constant(computed)
            return None if number is None else literal_text(number)


def plain_value(expression: Expression) -> str | None:
    """Return what a port is given for a constant or a name; None for what must be computed.

    Empty text means no value to BehaviorTree.CPP, and text in braces an entry: both are computed like an expression.
    """
    match expression:
        case Literal(value=str() as text) if not text or text.startswith(NOT_TAKEN_AS_WRITTEN):
            return None
        case Literal(value=value):
            return literal_text(value)
        case Individual(iri=iri):
            return iri
        case Variable(name=name):
            return f"{{{port(name)}}}"
        case _:
            return None


def port_type(type_: ValueType) -> str | None:
    """Return the C++ type of values in SI units and of names; None for poses, vectors and lists."""
    match type_:
        case NumberType():
            return "double"
        case PlainType(name=name):
            return PLAIN[name]
        case ClassType():
            return "std::string"
        case VectorType() | DirectionType() | ListType():
            return None
        case _:
            assert_never(type_)


def _given(parameter: Parameter) -> Port:
    return Port(given(parameter.name), "input", port_type(parameter.type), None, parameter.doc, parameter.name)


def _port(parameter: Parameter, direction: Direction | None = None) -> Port:
    return Port(
        port(parameter.name),
        direction or ("output" if parameter.direction == "out" else "input"),
        port_type(parameter.type),
        default_text(parameter),
        parameter.doc,
        parameter.name,
    )
