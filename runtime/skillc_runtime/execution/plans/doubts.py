"""What a step that failed was to achieve is not achieved because it was assumed on the way."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from skillc_model.conditions import Condition
from skillc_runtime.execution.plans.failed_steps import FailedStep, FailedSteps
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.grounds import find_grounds
from skillc_runtime.world.state.facts import Fact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError


def find_doubt(goal: Condition, failures: FailedSteps, world: WorldModel) -> Failure | None:
    """Return why a goal that holds does not count as reached; None if it does.

    It does not if a fact that it rests on is only assumed, was to be achieved by a step that failed, and has not been
    written since: a part that was let go in its place may not be there if what followed failed.
    """
    for ground in find_grounds(goal, world, {}):
        if ground.write is None or not ground.is_assumed:
            continue
        for failed in failures.failed:
            if ground.write.number <= failed.writes and ground.fact in _to_achieve(failed, failures, world):
                return _describe(failed, format_fact(label_fact(ground.fact, world.snapshot())))
    return None


def _to_achieve(failed: FailedStep, failures: FailedSteps, world: WorldModel) -> Iterator[Fact]:
    """Yield the facts that decide the postconditions of a failed step which did not hold when it started."""
    step = failed.step
    for post in failures.library.skills[step.skill].post:
        with suppress(EvaluationError):  # not every parameter of a call inside a step has a value
            if not evaluate(post.achieved, failed.state, step.arguments):
                yield from (ground.fact for ground in find_grounds(post.achieved, world, step.arguments))


def _describe(failed: FailedStep, fact: str) -> Failure:
    cause = failed.failure
    doubt = Failure(kind="plan", message=f"that `{fact}` is only assumed: {failed.step.skill} has failed since")
    return Failure(kind="post", message=cause.message, source=cause.source, causes=(cause, doubt))
