"""Primitives whose Python does not do what is expected: `tick` without a status, outputs that are never set."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath

from skillc_compiler.checks.bad_targets import split_target
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Implementation
from skillc_compiler.python.contracts import Breach
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
    if contract.breach is not None:
        one = contract.breach
        message = f"the `tick` of `{name}` {one.what} (line {one.line} of {PurePath(one.path).name})"
        help_ = "return `Status.RUNNING` or `Status.SUCCESS` on every way; to fail, raise `SkillFailure`"
        yield Diagnostic("broken-contract", written.span, message, help_, "warning", (_label(one, "here"),))
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


def _label(place: Breach, text: str) -> Label:
    return Label(Span(place.path, place.line, place.column, place.line, place.end_column), text)
