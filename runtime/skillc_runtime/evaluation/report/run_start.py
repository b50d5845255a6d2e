"""What is known of the result of a task when it starts: what measures it is not needed for that."""

from __future__ import annotations

from skillc_runtime.devices.backend import Backend
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.world.state.labels.labelled import LabelledIri
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE, COMPLIANT_CONTROLLER, HAS_ARM
from skillc_runtime.world.state.world_state import WorldState


def summarise_start(task: str, backend: Backend, speed: float = 1.0) -> TaskResult:
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
        speed=speed,
        dry=backend.capabilities.commands is not None,
    )


def _robots(state: WorldState) -> list[LabelledIri]:
    """Return the robots that have arms, and the arms without a robot."""
    robots = {min(state.subjects(HAS_ARM, arm), default=arm) for arm in state.instances(ARM_DEVICE)}
    return [label(each, state.vocabulary) for each in sorted(robots, key=state.vocabulary.short)]


def _controllers(state: WorldState) -> list[str]:
    found = (state.value(arm, COMPLIANT_CONTROLLER) for arm in state.instances(ARM_DEVICE))
    return sorted({str(controller) for controller in found if controller is not None})
