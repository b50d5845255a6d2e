"""What is wrong with a run of a test, as diagnostics: an expectation that was not met, and the path that led there."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from skillc.services.testing.path import TakenCall
from skillc.services.testing.running import TestRun, describe_end
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_model.skills import Expectation, Test
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.python_calls import EvaluationError

FAILED = "test-failed"
MOST_STEPS = 12
"""The most steps of a path that are labelled: the last ones."""
BROKEN = "; this broke what is to hold always"


def find_failures(test: Test, run: TestRun, display_path: Callable[[str], str]) -> tuple[Diagnostic, ...]:
    """Return what is not as a test expects, each with the calls that led there; `display_path` shows a source."""

    def place(position: Position) -> Span:
        return Span(display_path(position.path), position.line, position.column, position.line, position.column + 1)

    path = tuple(_label_path(run, place))
    return tuple(
        Diagnostic(FAILED, place(position), message, help_, labels=path)
        for position, message, help_ in (*_unexpected_end(test, run), *_unmet(test, run))
    )


def _unexpected_end(test: Test, run: TestRun) -> Iterator[tuple[Position, str, str]]:
    """Yield that a task did not succeed although nothing says that it shall fail."""
    end = describe_end(run)
    wants_end = any(each.condition is None for each in test.expects)
    if end and not wants_end:
        what = "did not start" if run.refused else "failed"
        help_ = 'fix what led there, or write `expect failure "TEXT"` if it shall fail'
        yield test.source, f"`{test.name}` {what}: {end}", help_


def _unmet(test: Test, run: TestRun) -> Iterator[tuple[Position, str, str]]:
    for each in test.expects:
        if (why := _find_difference(each, run)) is not None:
            yield each.source, why, ""


def _find_difference(expected: Expectation, run: TestRun) -> str | None:
    """Return how a run differs from what is expected; None if it does not."""
    if expected.condition is not None:
        return _find_false(expected, run)
    end = describe_end(run)
    if expected.failure is not None:
        if not end:
            return f"it succeeded, but a failure with `{expected.failure}` was expected"
        return None if expected.failure.lower() in end.lower() else f"it failed, but for another reason: {end}"
    if run.proved:
        return None
    return f"nothing proves that there is no plan: {run.refused}" if run.refused else "there is a plan"


def _find_false(expected: Expectation, run: TestRun) -> str | None:
    assert expected.condition is not None, "a condition is expected"
    try:
        if evaluate(expected.condition, run.state, {}):
            return None
        instead = explain(expected.condition, run.state, {}, run.state.vocabulary)
    except EvaluationError as error:
        return f"`{expected.text}` cannot be evaluated: {error}"
    return f"`{expected.text}` does not hold at the end: {instead}"


def _label_path(run: TestRun, place: Callable[[Position], Span]) -> Iterator[Label]:
    """Yield the steps of a run with how each ended, and the calls inside the one that failed or broke `always`."""
    failed, steps, broke = run.path.failed, run.path.steps, _find_break(run)
    for number, step in enumerate(steps, 1):
        if number > len(steps) - MOST_STEPS:
            yield Label(place(step.source), f"{number}: {_describe(step)}{BROKEN if step is broke else ''}")
    yield from (Label(place(each.source), f"inside: {_describe(each)}") for each in failed[1:])
    if broke is not None and broke not in steps:
        yield Label(place(broke.source), f"inside: {_describe(broke)}{BROKEN}")


def _find_break(run: TestRun) -> TakenCall | None:
    """Return the call whose effects broke what holds always; None if nothing is broken, or if it is not clear."""
    broken = run.failure is not None and run.failure.kind == "always"
    return run.path.find_last(run.failure.skill) if run.failure is not None and broken else None


def _describe(call: TakenCall) -> str:
    if not call.status:
        return f"{call.name} began at {call.began_s:g} s"
    ended = {"success": "succeeded", "failure": "failed", "halted": "was halted"}.get(call.status, call.status)
    why = f": {call.why}" if call.why and call.status == "failure" else ""
    return f"{call.name} {ended} after {round(call.ended_s - call.began_s, 2):g} s{why}"
