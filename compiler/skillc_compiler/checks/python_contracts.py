"""Primitives whose Python does not do what is expected: `tick` without a status, outputs that are never set."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from skillc_compiler.checks.bad_targets import split_target
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Implementation
from skillc_compiler.program.types import BOOL, INT, MESSAGE, TEXT, UNKNOWN, Measure, Thing, Type, describe_type
from skillc_compiler.python.contracts import Breach, Constant, Contract
from skillc_compiler.python.targets import NamedPython
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean

NAMES = ("broken-contract",)
NEEDS = Need.BODY
READS = Reads.PYTHON


def check(of: NamedPython) -> Iterator[Diagnostic]:
    """Yield a problem for each primitive that cannot do what its skill says."""
    for implementation in of.program.implementations:
        if isinstance(implementation.body, s.RunPython):
            yield from _check(of, implementation, implementation.body.target)


def _check(of: NamedPython, implementation: Implementation, written: s.Text) -> Iterator[Diagnostic]:
    target = split_target(written.value)
    if target is None:
        return
    contract, name = of.targets.contract(*target), target[1]
    for message, help_, place in _find_breaches(contract, name, implementation):
        where = f"line {place.line} of {PurePath(place.path).name}"
        yield Diagnostic(
            "broken-contract", written.span, f"{message} ({where})", help_, "warning", (_label(place, "here"),)
        )
    if contract.outputs is None or contract.place is None:
        return
    for parameter in implementation.parameters:
        if parameter.direction == "out" and parameter.name not in contract.outputs:
            yield Diagnostic(
                "broken-contract",
                written.span,
                f"`{name}` never sets the output `{parameter.name}`",
                help=did_you_mean(parameter.name, contract.outputs)
                or f'set `self.outputs["{parameter.name}"]` before it returns `Status.SUCCESS`',
                severity="warning",
                labels=(Label(parameter.span, "declared here"), _label(contract.place, "the class")),
            )


def _find_breaches(contract: Contract, name: str, implementation: Implementation) -> Iterator[tuple[str, str, Breach]]:
    """Yield what a class does wrong, what to do about it, and where it does it."""
    if (one := contract.constructor) is not None:
        yield f"the `__init__` of `{name}` {one.what}", "call `super().__init__(cell)` in it", one
    if (one := contract.breach) is not None:
        help_ = "return `Status.RUNNING` or `Status.SUCCESS` on every way; to fail, raise `SkillFailure`"
        yield f"the `tick` of `{name}` {one.what}", help_, one
    for output, value, place in contract.constants:
        parameter = next((each for each in implementation.parameters if each.name == output), None)
        if parameter is not None and parameter.direction == "out" and not _may_be(value, parameter.type):
            wanted = f"`{output}` is {describe_type(parameter.type)}"
            yield f"`{name}` sets the output `{output}` to {place.what}", wanted, place
    labels = [each.label.text for each in implementation.skill.outcomes if each.label is not None]
    all_ = f"it has {', '.join(f'`{each}`' for each in labels)}" if labels else "nothing can come of it but success"
    for label, place in contract.outcomes:
        if label not in labels:
            message = f"`{implementation.skill.name}` has no outcome `{label}`, with which `{name}` ends"
            yield message, did_you_mean(label, labels) or all_, place


def _may_be(value: Constant, type_: Type) -> bool:
    """Whether a constant of Python may be a value of a type."""
    match value:
        case bool():
            return type_ in (BOOL, UNKNOWN)
        case int() | float():
            return isinstance(type_, Measure) or type_ in (INT, UNKNOWN)
        case str():
            return isinstance(type_, Thing) or type_ in (TEXT, MESSAGE, UNKNOWN)
        case _:
            return type_ == UNKNOWN


def _label(place: Breach, text: str) -> Label:
    return Label(Span(place.path, place.line, place.column, place.line, place.end_column), text)
