"""The ports of skills, and their attributes in a call.

BehaviorTree.CPP rejects a call of a tree that does not map every declared port without a default. So a tree declares
only the ports that every caller maps and those with a default; other ports may be mapped without a declaration.

A constant that is passed to a tree becomes a blackboard entry. Since version 4.9 the type of the entry is inferred from
the text: `12` is an int; `12.0`, `1e3` and `nan` are doubles. The port that reads it must have the same type, so
numbers are written according to their type, and text that looks like a number is not written as a constant.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.emit.bt.model import Direction, Port
from skillc_compiler.emit.bt.names import NOT_IN_XML, given_port, port_name
from skillc_model.conditions import Expression, Individual, Literal
from skillc_model.rewriting import constant_number
from skillc_model.skills import Parameter
from skillc_rdf.vocabulary.types import ClassType, DirectionType, ListType, NumberType, PlainType, ValueType, VectorType

PLAIN = {"Bool": "bool", "Int": "int", "Text": "std::string", "Message": "std::string", "Pose": None}
TAKEN_OTHERWISE = re.compile(
    r"|=| *\{.*|json:.*"  # empty, an entry, JSON
    r"|-?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?|-?inf(inity)?|-?nan(\(\w*\))?",  # a number
    re.IGNORECASE | re.ASCII | re.DOTALL,
)
"""Text that BehaviorTree.CPP does not read literally."""
INT_MIN, INT_MAX = -(2**31), 2**31 - 1


def action_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a single action whose parameters all have values."""
    return tuple(_port(each) for each in parameters)


def whole_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a node that runs a whole skill and infers the parameters that are not passed."""
    return tuple(_given(each) if each.direction == "infer" else _port(each) for each in parameters)


def inferring_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of an action that infers parameters, except those that are passed."""
    inferred = [each for each in parameters if each.direction == "infer"]
    return (*whole_ports(parameters), *(_port(each, "output") for each in inferred))


def tree_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the declared ports of a skill's tree: required parameters, parameters with a default, and outputs."""
    return tuple(_port(each) for each in parameters if each.direction in ("in", "out") or format_default(each))


def call_port(parameter: Parameter) -> str:
    """Return the port through which a caller passes a parameter."""
    return given_port(parameter.name) if parameter.direction == "infer" else port_name(parameter.name)


def default_attributes(parameters: Sequence[Parameter]) -> dict[str, str]:
    """Return the attributes that set every parameter with a default to its default."""
    texts = ((port_name(each.name), format_default(each)) for each in parameters)
    return {name: text for name, text in texts if text}


def forward_parameters(parameters: Sequence[Parameter]) -> dict[str, str]:
    """Return the attributes that map each parameter to the entry of its name."""
    return {port_name(each.name): f"{{{port_name(each.name)}}}" for each in parameters}


def format_default(parameter: Parameter) -> str | None:
    """Return the default as text for a port, None if there is none or a port cannot represent it."""
    match parameter.default:
        case None:
            return None
        case Literal() | Individual() as value:
            return format_plain_value(value, port_type(parameter.type))
        case computed:
            number = constant_number(computed)
            return None if number is None else format_plain_value(Literal(number), port_type(parameter.type))


def format_plain_value(expression: Expression, type_: str | None) -> str | None:
    """Return a constant or an individual as text for a port of a C++ type; None for expressions to be computed."""
    match expression:
        case Literal(value=value):
            return format_constant(value, type_)
        case Individual(iri=iri):
            return iri
        case _:
            return None


def format_constant(value: bool | int | float | str, type_: str | None) -> str | None:
    """Return a constant as text that every version of BehaviorTree.CPP reads as this type, None if there is none."""
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            return None if TAKEN_OTHERWISE.fullmatch(value) or NOT_IN_XML.search(value) else value
        case int() | float() if type_ == "int":
            return str(int(value)) if INT_MIN <= value <= INT_MAX else None
        case int() | float():
            return repr(float(value))
        case _:
            assert_never(value)


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
    return Port(given_port(parameter.name), "input", port_type(parameter.type), None, parameter.doc, parameter.name)


def _port(parameter: Parameter, direction: Direction | None = None) -> Port:
    return Port(
        port_name(parameter.name),
        direction or ("output" if parameter.direction == "out" else "input"),
        port_type(parameter.type),
        format_default(parameter),
        parameter.doc,
        parameter.name,
    )
