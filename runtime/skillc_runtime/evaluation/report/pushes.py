"""Finds in a run when arms pressed their tools on something, and measures it: any skill in which something pushes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import msgspec
import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth, Recording
from skillc_runtime.evaluation.metrics.intervals import Interval
from skillc_runtime.evaluation.report.result import ForceSource, PushResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.run_trace import ArmPath
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.history.history import RecordedCall
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity, LabelledVector
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE, BUTTON, END_EFFECTOR, FIXTURE, LOCATION, ROBOT, SURFACE
from skillc_runtime.world.state.world_state import WorldState

ARM, ALONG, FORCE = "arm", "along", "force"
"""The parameters of primitives that press: which arm, opposite to which direction, with how many N."""

TOUCHED_N, KNOWN_SHARE = 1.0, 0.3
"""A tool touches something while the simulator has more than this, or, without that, while the arm knows of more than
this share of the commanded force."""

LEAST_SAMPLES = 3

DEVICES = (ARM_DEVICE, END_EFFECTOR, ROBOT)


class PushRecord(msgspec.Struct, frozen=True):
    """A scope in which an arm pressed its tool opposite to `along`, a unit vector (3,) in the world, with `force_n`.

    `within` is the call of the skill around it, `on` are the individuals it names besides devices, by IRI; `body` is
    what was done in the scope. `samples` are from shortly before the push to its end. `truth` (m, 2) are times in s and
    forces in N of the simulator, on a button or else of the held tool, None for neither. `contact_s` is when the tool
    touched something: by the truth, or else when the arm knew a part of the commanded force; None if it never did.
    """

    within: RecordedCall
    on: tuple[str, ...]
    arm: str
    along: Array
    force_n: float
    start_s: float
    end_s: float
    body: tuple[RecordedCall, ...]
    samples: ArmPath
    truth: Array | None
    contact_s: float | None

    @property
    def force(self) -> Array:
        """The force (n,) in N against the push, as the arm knows it."""
        return np.asarray(self.samples.force @ self.along)

    @property
    def travel_mm(self) -> Array:
        """How far (n,) the tool is in the direction of the push from where it touched, or from its start, in mm."""
        down = -1e3 * (self.samples.position @ self.along)
        zero = self.start_s if self.contact_s is None else self.contact_s
        return np.asarray(down - down[min(int(np.searchsorted(self.samples.time, zero)), len(down) - 1)])


def find_pushes(record: RunRecord) -> tuple[PushRecord, ...]:
    """Return all pushes of a run in order of time, also those that failed or were halted."""
    found = [push for attempt in record.history.attempts for push in _find_among(attempt.steps, (), record)]
    return tuple(sorted(found, key=lambda push: (push.start_s, push.arm)))


def measure_push(push: PushRecord, record: RunRecord) -> PushResult:
    """Return the numbers of a push."""
    vocabulary, truth, contact = record.state.vocabulary, push.truth, push.contact_s
    known = push.force[push.samples.time >= contact] if contact is not None else np.zeros(0)
    pressed = truth[truth[:, 1] > TOUCHED_N, 1] if truth is not None else np.zeros(0)
    return PushResult(
        skill=push.within.skill,
        arm=label(push.arm, vocabulary),
        on=tuple(label(each, vocabulary) for each in push.on),
        start_s=push.start_s,
        end_s=push.end_s,
        contact_s=contact,
        force_command_n=push.force_n,
        force_mean_n=float(known.mean()) if known.size else None,
        force_greatest_n=float(known.max()) if known.size else None,
        force_source=find_force_source(push.arm, record),
        true_mean_n=float(pressed.mean()) if pressed.size else None,
        true_greatest_n=float(pressed.max()) if pressed.size else None,
        travel_mm=float(push.travel_mm.max()) if contact is not None else None,
    )


def find_force_source(arm: str, record: RunRecord) -> ForceSource:
    """Return whether an arm has a force-torque sensor, or estimates forces."""
    return "sensor" if record.has_force_sensor(arm) else "estimate"


def _find_true_force(on: Sequence[str], arm: str, scope: Interval, record: RunRecord) -> Array | None:
    """Return times and forces (n, 2) of the simulator in an interval: on a button, else of the held tool."""
    if record.truth is None:
        return None
    start, end = scope
    for button in (each for each in on if record.state.is_a(each, BUTTON)):
        rows = record.truth.pressing(button)
        inside = rows[(rows[:, 0] >= start) & (rows[:, 0] <= end), :2]
        return inside if len(inside) else None
    for tool in record.held_by(arm, start, end):
        held = _recording(tool, record.truth).between(start, end)
        if len(held.time):
            return np.column_stack([held.time, held.force])
    return None


def _find_contact(samples: ArmPath, along: Array, force_n: float, truth: Array | None, start: float) -> float | None:
    """Return when the tool touched something, in s; None if it did not."""
    known = np.column_stack([samples.time, samples.force @ along])
    rows, least_n = (known[known[:, 0] >= start], KNOWN_SHARE * force_n) if truth is None else (truth, TOUCHED_N)
    touching = np.flatnonzero(rows[:, 1] > least_n)
    return float(rows[touching[0], 0]) if touching.size else None


def _recording(tool: str, truth: GroundTruth) -> Recording:
    try:
        return truth.recording(tool)
    except KeyError:
        return Recording(np.empty((0, 25)))


def _find_among(
    calls: Sequence[RecordedCall], around: tuple[RecordedCall, ...], record: RunRecord
) -> Iterator[PushRecord]:
    """Yield the pushes in the calls of a body, which is within the calls `around`, the outermost first."""
    for call in calls:
        if call.until is not None and around:
            yield from _read_scope(call, (call.started or 0.0, call.until), calls, around, record)
        yield from _find_among(call.calls, around if call.activity else (*around, call), record)


def _read_scope(
    opening: RecordedCall,
    scope: Interval,
    calls: Sequence[RecordedCall],
    around: tuple[RecordedCall, ...],
    record: RunRecord,
) -> Iterator[PushRecord]:
    """Yield the push that lasts as long as a scope, if its opening call presses."""
    pressing = next((each for each in opening.all if each.activity == "press"), None)
    if pressing is None:
        return
    arm, along, force = (pressing.bindings.get(name) for name in (ARM, ALONG, FORCE))
    if not (isinstance(arm, LabelledIri) and isinstance(along, LabelledVector) and isinstance(force, LabelledQuantity)):
        return
    samples = record.arm_path(arm.iri).between(scope[0] - 0.5, scope[1])
    if len(samples.time) >= LEAST_SAMPLES:
        on, axis = _find_objects(around, record), np.array(along.components)
        truth = _find_true_force(on, arm.iri, scope, record)
        contact_s = _find_contact(samples, axis, force.value, truth, scope[0])
        body = tuple(each for each in calls if each is not opening and _is_within(each, scope))
        yield PushRecord(around[-1], on, arm.iri, axis, force.value, *scope, body, samples, truth, contact_s)


def _is_within(call: RecordedCall, scope: Interval) -> bool:
    return call.started is not None and scope[0] <= call.started <= scope[1]


def _find_objects(calls: tuple[RecordedCall, ...], record: RunRecord) -> tuple[str, ...]:
    """Return the individuals besides devices and places that the innermost call with any of them names."""
    for call in reversed(calls):
        found = [each for each in call.individuals if _is_object(each, record.state)]
        if found:
            return tuple(dict.fromkeys(found))
    return ()


def _is_object(individual: str, state: WorldState) -> bool:
    """Whether something can be pressed on: no device, and no place that is neither a fixture nor a surface."""
    if individual not in state.individuals or any(state.is_a(individual, kind) for kind in DEVICES):
        return False
    return not state.is_a(individual, LOCATION) or any(state.is_a(individual, kind) for kind in (FIXTURE, SURFACE))


@dataclass(frozen=True, slots=True)
class PushDrawing:
    """A push to draw: where the arm knows its force from, and when a button in it switched, None if none did."""

    push: PushRecord
    source: ForceSource
    switched_s: float | None


def make_push_drawing(push: PushRecord, record: RunRecord) -> PushDrawing:
    """Return what is drawn of a push."""
    return PushDrawing(push, find_force_source(push.arm, record), _find_switching(push, record))


def _find_switching(push: PushRecord, record: RunRecord) -> float | None:
    if record.truth is None:
        return None
    for button in (each for each in push.on if record.state.is_a(each, BUTTON)):
        rows = record.truth.pressing(button)
        switched = rows[(rows[:, 2] > 0) & (rows[:, 0] >= push.start_s) & (rows[:, 0] <= push.end_s), 0]
        if switched.size:
            return float(switched[0])
    return None
