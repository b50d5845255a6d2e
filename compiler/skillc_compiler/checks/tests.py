"""A test that does not say what is so at its start, or expects what excludes each other."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Test
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("start-not-literal", "contradicting-expectations")
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems of the `start` and `expect` lines of each test."""
    for task in program.tasks:
        if isinstance(task, Test):
            yield from _check_starts(task)
            yield from _check_expectations(task)


def _check_starts(test: Test) -> Iterator[Diagnostic]:
    for part in (each for start in test.starts for each in effects_of(start) if isinstance(each, NoEffect)):
        yield Diagnostic(
            "start-not-literal",
            part.span,
            f"this does not say what is so at the start: {part.reason}",
            help="write relations and `property == value` joined by `and`",
        )


def _check_expectations(test: Test) -> Iterator[Diagnostic]:
    """Yield what excludes another expectation, or cannot come about."""
    no_plan = [each for each in test.expects if each.is_no_plan]
    others = [each for each in test.expects if not each.is_no_plan]
    for each in no_plan if test.goal is None and test.body is not None else ():
        yield Diagnostic(
            "contradicting-expectations",
            each.span,
            "a body is not planned, so there is always a plan",
            help='write `goal CONDITION` in place of `do NODE`, or `expect failure "TEXT"`',
        )
    for each in no_plan[:1] if others else ():
        yield Diagnostic(
            "contradicting-expectations",
            each.span,
            "without a plan nothing is run of which anything else could be expected",
            help="keep one of the two, or write two tests",
            labels=(Label(others[0].span, "the other one"),),
        )
