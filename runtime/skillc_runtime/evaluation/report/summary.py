"""Makes the result of a task from its execution."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any, Literal

from msgspec import structs

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.evaluation.report.handlings import find_handlings, find_targets
from skillc_runtime.evaluation.report.placements import measure_placements
from skillc_runtime.evaluation.report.result import ChoiceResult, FailedCall, StepResult, TaskResult, TouchResult
from skillc_runtime.evaluation.report.wiping import Wiping, rate_wiping
from skillc_runtime.evaluation.report.work_result import WorkResult
from skillc_runtime.execution.attempt import AttemptResult
from skillc_runtime.execution.execute import Execution
from skillc_runtime.planning.plan import describe_quality
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.recording.states import EndState
from skillc_runtime.world.state.labelled import LabelledIri
from skillc_runtime.world.state.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE, COMPLIANT_CONTROLLER, HAS_ARM
from skillc_runtime.world.state.world_state import WorldState


def summarise_start(task: str, backend: Backend) -> TaskResult:
    """Return what is known of the result of a task when it starts."""
    state, truth = backend.cell.world.snapshot(), backend.capabilities.truth
    return TaskResult(
        task=task,
        status="interrupted",
        robots=tuple(_robots(state)),
        controllers=tuple(_controllers(state)),
        seed=0 if truth is None else truth.seed,
        variation="" if truth is None else truth.variation,
        simulated=truth is not None,
    )


def summarise_run(
    execution: Execution[Any],
    choices: Mapping[int, ImplementationChosen],
    library: SkillLibrary,
    wipings: Sequence[Wiping],
    backend: Backend,
    works: tuple[WorkResult, ...] = (),
    began_s: float = 0.0,
) -> TaskResult:
    """Return the result of a task for reports, tables and JSON; `wipings` and `works` were found in it.

    The task began at `began_s` of its cell.
    """
    state, truth = backend.cell.world.snapshot(), backend.capabilities.truth
    handlings = find_handlings((each.tree for each in execution.attempts), choices, state)
    judged = () if truth is None else tuple(rate_wiping(wiping, state, truth) for wiping in wipings)
    took_s, wall = backend.clock.now - began_s, execution.wall_time_s
    result = structs.replace(
        summarise_start(execution.task, backend),
        status=_find_status(execution),
        verified=execution.verified,
        facts=execution.facts,
        false_claims=execution.false_claims,
        sim_time_s=took_s,
        wall_time_s=wall,
        real_time_factor=took_s / wall if wall else 0.0,
        wiping=judged[0] if judged else None,
        wipings=judged,
        placements=measure_placements(backend.cell.world, truth, find_targets(handlings)),
        works=works,
        touches=() if truth is None else tuple(TouchResult(**asdict(each)) for each in truth.contacts()),
        replanned=tuple(each.reason for each in execution.attempts[:-1]),
        failure=describe_failure(execution.failure) if execution.failure else None,
        cause=execution.failure,
    )
    return _add_attempt(result, execution.last, choices, library) if execution.attempts else result


def _find_status(execution: Execution[Any]) -> EndState | Literal["refused"]:
    """Return how a task ended; it is refused if it could not be prepared, so that nothing ran."""
    failure = execution.failure
    unprepared = not execution.attempts and failure is not None and failure.kind == "plan"
    return "refused" if unprepared else execution.status


def _add_attempt(
    result: TaskResult, last: AttemptResult, choices: Mapping[int, ImplementationChosen], library: SkillLibrary
) -> TaskResult:
    """Return a result with what the last attempt planned and did."""
    solved = last.prepared.planned.solved if last.prepared.planned else None
    return structs.replace(
        result,
        plan=_make_steps(last.tree, choices, library),
        choices=_make_choices(choices, library),
        plan_optimal=None if solved is None else solved.optimal == "proven",
        plan_quality="" if solved is None else describe_quality(solved.optimal, solved.left_out, solved.at_least_s),
        planner="" if solved is None else solved.planner,
        failed_calls=tuple(_failed_calls(last.tree)) if result.status == "failed" else (),
    )


def _make_steps(
    tree: NodeOutcome, choices: Mapping[int, ImplementationChosen], library: SkillLibrary
) -> tuple[StepResult, ...]:
    """Return the outermost calls of the tree in the order of their starts; those that never started come last."""
    calls = sorted(_outermost_calls(tree), key=lambda call: (call.started is None, call.started))
    return tuple(_make_step(call, choices.get(call.id), library) for call in calls)


def _outermost_calls(tree: NodeOutcome) -> Iterator[NodeOutcome]:
    """Yield the outermost calls; one that was not needed has the status `skipped`."""
    if tree.kind == "call":
        yield tree
    for child in () if tree.kind == "call" else tree.children:
        is_skipped = tree.kind == "if" and tree.status == "success" and child.status == "idle"
        yield from _outermost_calls(structs.replace(child, status="skipped") if is_skipped else child)


def _make_step(call: NodeOutcome, choice: ImplementationChosen | None, library: SkillLibrary) -> StepResult:
    skill = choice.skill if choice else call.name
    objects = {p.name for p in library.skills[skill].parameters if p.direction in ("in", "infer")}
    bindings = choice.bindings if choice else {}
    return StepResult(
        skill=skill,
        implementation=choice.implementation if choice else "",
        arguments={name: value for name, value in bindings.items() if name in objects},
        source=str(choice.source if choice else call.source),
        status=call.status,
        alternatives=len(library.skills[skill].implementations) - 1,
        rejected=call.rejected,
    )


def _make_choices(choices: Mapping[int, ImplementationChosen], library: SkillLibrary) -> tuple[ChoiceResult, ...]:
    """Return each choice between several implementations once."""
    found = {
        (choice.skill, choice.implementation): ChoiceResult(
            skill=choice.skill, implementation=choice.implementation, rejected=choice.rejected
        )
        for choice in choices.values()
        if len(library.skills[choice.skill].implementations) > 1
    }
    return tuple(found[key] for key in sorted(found))


def _robots(state: WorldState) -> list[LabelledIri]:
    """Return the robots that have arms, and the arms without a robot."""
    robots = {min(state.subjects(HAS_ARM, arm), default=arm) for arm in state.instances(ARM_DEVICE)}
    return [label(each, state.vocabulary) for each in sorted(robots, key=state.vocabulary.short)]


def _controllers(state: WorldState) -> list[str]:
    found = (state.value(arm, COMPLIANT_CONTROLLER) for arm in state.instances(ARM_DEVICE))
    return sorted({str(controller) for controller in found if controller is not None})


def _failed_calls(node: NodeOutcome) -> Iterator[FailedCall]:
    """Yield the calls from the top of the tree to the innermost one that failed."""
    if node.kind == "call":
        yield FailedCall(name=node.name, source=node.source)
    failed = [child for child in node.children if child.status == "failure"]
    if failed:
        yield from _failed_calls(failed[-1])
