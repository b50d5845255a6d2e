"""Changes that every success undoes and that a failure in between leaves behind."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from skillc_compiler.analysis.exploration import CallEffect, Exploration
from skillc_compiler.analysis.findings import Finding, LeakedChange
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.apply_effects import apply_effects
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, write_of
from skillc_compiler.analysis.paths import EndStates, Path, PathStep, path_length
from skillc_compiler.program.typed import Call
from skillc_dsl.source import Span
from skillc_model.conditions import Condition, Effect


def find_leaked(
    run: Exploration, one: CallEffect, condition: Condition, start: State, ends: EndStates
) -> Iterator[Finding]:
    """Yield a value that no success keeps and that a failure after the effect leaves changed.

    Relations are not device states: a failure leaves objects where they are. If the undoing call itself fails, nothing
    could have undone the effect, whatever fails after it.
    """
    if (
        one.post.sensed
        or not isinstance(write_of(one.effect), PropertyWrite)
        or not ends.success
        or evaluate(run.types, start, condition) is not False
    ):
        return
    if all(evaluate(run.types, state, condition) is False for state in ends.success):
        failed = ends.failed
        undoing = {
            each.call.written.span for each in run.effects.values() if _undoes(run.types, each.effect, condition)
        }
        left = [
            path
            for state, path in failed.items()
            if path is not None and contains_call(path, one.call) and not _tried_after(path, one.call, undoing)
            if evaluate(run.types, state, condition)
        ]
        if left:
            yield LeakedChange(one.call, one.post, min(left, key=path_length))


def _tried_after(path: PathStep, call: Call, undoing: Collection[Span]) -> bool:
    """Whether something that undoes it was tried after the last time that a call had its effect."""
    spans = [step.span for step in path]
    last = max(number for number, span in enumerate(spans) if span == call.written.span)
    return any(span in undoing for span in spans[last + 1 :])


def _undoes(types: AliasTypes, effect: Effect, condition: Condition) -> bool:
    """Whether an effect makes a condition false."""
    return evaluate(types, apply_effects(types, State(), [effect]), condition) is False


def contains_call(path: Path, call: Call) -> bool:
    """Whether a path leads over a call."""
    return path is not None and any(each.span == call.written.span for each in path)


def find_last_call(path: Path, effects: Sequence[CallEffect]) -> CallEffect | None:
    """Return the effect of the last call on a path that is one of these; None without such a call."""
    by_call = {each.call.written.span: each for each in effects}
    steps = [] if path is None else [*path]
    return next((by_call[step.span] for step in reversed(steps) if step.span in by_call), None)
