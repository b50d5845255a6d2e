"""The ports of skills, and what is written for them in a call.

BehaviorTree.CPP refuses a call of a tree that does not map each port of its model that has no default. So a tree
declares what every caller passes, and what has a default; the rest may be mapped, but need not be.
"""

from __future__ import annotations

from collections.abc import Sequence

from skillc_compiler.emit.bt_model import Port
from skillc_compiler.emit.bt_names import port
from skillc_compiler.emit.phrases import literal_text
from skillc_compiler.library.conditions import Expression, Individual, Literal, Variable
from skillc_compiler.library.pddl.rewriting import constant
from skillc_compiler.library.skills import Parameter

DIRECTIONS = {"in": "input", "opt": "input", "infer": "inout", "out": "output"}


def action_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a skill that is one action: an inferred parameter may be passed or found."""
    return tuple(
        Port(port(each.name), DIRECTIONS[each.direction], default_text(each), each.doc)  # type: ignore[arg-type]
        for each in parameters
    )


def tree_ports(parameters: Sequence[Parameter]) -> tuple[Port, ...]:
    """Return the ports of a skill that is a tree: the required parameters and those with a default."""
    return action_ports([each for each in parameters if each.direction == "in" or default_text(each)])


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
            return plain_value(value) or None
        case computed:
            number = constant(computed)
            return None if number is None else literal_text(number)


def plain_value(expression: Expression) -> str | None:
    """Return what a port is given for a constant or a name; None for what must be computed."""
    match expression:
        case Literal(value=value):
            return literal_text(value)
        case Individual(iri=iri):
            return iri
        case Variable(name=name):
            return f"{{{port(name)}}}"
        case _:
            return None
