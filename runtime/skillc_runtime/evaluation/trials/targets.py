"""The metrics of each kind of work, with the targets for each trial and for the median of all trials."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Generic, Literal, TypeVar, assert_never

from skillc_runtime.evaluation.measures.work import (
    InsertingWork,
    PlacingWork,
    PolishingWork,
    PressingWork,
    TeachingWork,
    WipingWork,
    Work,
)
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.trials.trial import Trial

Result = TypeVar("Result", contravariant=True)


@dataclass(frozen=True, slots=True)
class Metric(Generic[Result]):
    """A number `of` one piece of work, in `unit`; None if it was not measured.

    In every trial it must be `sense` (at least, at most) the `target`; the median of all trials must be at most the
    `median_target`, if there is one.
    """

    name: str
    unit: str
    of: Callable[[Result], float | None]
    sense: Literal["at-least", "at-most"]
    target: float | None = None
    median_target: float | None = None

    def is_met(self, value: float) -> bool:
        """Whether a value meets the target."""
        if self.target is None:
            return True
        return value >= self.target if self.sense == "at-least" else value <= self.target

    @property
    def target_text(self) -> str:
        """The target as text."""
        if self.target is None:
            return "no target"
        return f"{self.sense.replace('-', ' ')} {self.target:g} {self.unit}"


WIPING: tuple[Metric[WipingResult], ...] = (
    Metric("coverage", "%", lambda w: 100 * w.coverage, "at-least", 100.0),
    Metric("mean force error", "%", lambda w: 100 * abs(w.force_mean_n / w.force_command_n - 1), "at-most", 2.0),
    Metric("force RMSE", "% of F", lambda w: 100 * w.force_rmse_n / w.force_command_n, "at-most", 10.0, 5.0),
    Metric("contact lost", "%", lambda w: 100 * w.contact_lost, "at-most", 0.0),
    Metric("first impact", "x F", lambda w: w.first_impact_n / w.force_command_n, "at-most", 2.0),
    Metric("vibration", "mm/s", lambda w: w.vibration_mm_s, "at-most", 1.0),
    Metric("tilt", "deg rms", lambda w: w.tilt_rms_deg, "at-most", 0.5),
    Metric("tracking", "mm rms", lambda w: w.tracking_rms_mm, "at-most"),
    Metric("lane-end dwell", "s", lambda w: w.lane_dwell_s, "at-most", 0.02),
)

POLISHING: tuple[Metric[PolishingWork], ...] = (
    Metric("polished area", "%", lambda w: 100 * w.polished_share, "at-least", 99.0),
    Metric(
        "overlay amplitude", "%", lambda w: _percent(w.overlay_amplitude_m, w.commanded_amplitude_m), "at-least", 90.0
    ),
)

PRESSING: tuple[Metric[PressingWork], ...] = (
    Metric("held force", "% of F", lambda w: 100 * w.held_n / w.required_n, "at-least", 95.0),
    Metric("greatest force", "% of F", lambda w: 100 * w.greatest_n / w.required_n, "at-most", 120.0),
    Metric("time", "% of the skill's", lambda w: _percent(w.duration_share, 1.0), "at-most", 100.0),
)

INSERTING: tuple[Metric[InsertingWork], ...] = (
    Metric("depth", "% of the hole", lambda w: 100 * w.depth_m / w.hole_depth_m, "at-least", 98.0),
    Metric("greatest force", "N", lambda w: w.greatest_n, "at-most", 40.0),
    Metric("time", "% of the skill's", lambda w: _percent(w.duration_share, 1.0), "at-most", 100.0),
)

TEACHING: tuple[Metric[TeachingWork], ...] = (
    Metric("position error", "mm", lambda w: 1e3 * w.position_error_m, "at-most", 5.0),
    Metric("greatest force of the person", "N", lambda w: w.greatest_n, "at-most", 25.0),
    Metric("mean force of the person", "N", lambda w: w.mean_n, "at-most", 10.0),
    Metric("time", "% of the skill's", lambda w: _percent(w.duration_share, 1.0), "at-most", 100.0),
)

PLACING: tuple[Metric[PlacingWork], ...] = (
    Metric("error of placement", "mm", lambda w: 1e3 * w.error_m, "at-most"),
    Metric("turned from the believed pose", "deg", lambda w: w.turned_deg, "at-most"),
    Metric("beside the intended place", "mm", lambda w: None if w.missed_m is None else 1e3 * w.missed_m, "at-most"),
)

RUNNING: tuple[Metric[Trial], ...] = (
    Metric("simulated time", "s", lambda t: t.sim_time_s or None, "at-most"),
    Metric("peak force", "N", lambda t: t.greatest_force_n, "at-most"),
)
"""The metrics of every task that ran: its time, and the force on its tools if there was any."""

METRICS: Mapping[str, tuple[Metric[Any], ...]] = {
    "wiping": WIPING,
    "polishing": (*POLISHING, *WIPING),
    "pressing": PRESSING,
    "inserting": INSERTING,
    "teaching": TEACHING,
    "placing": PLACING,
}
"""All metrics of each kind of work."""


@dataclass(frozen=True, slots=True)
class MetricValue:
    """The value of a metric of one piece of work; `subject` is the object that was worked on, empty for a run."""

    metric: Metric[Any]
    subject: str
    value: float


def list_trial_values(trial: Trial) -> Iterator[MetricValue]:
    """Yield all measurements of a trial: of each piece of work, then of the whole run, whose subject is empty."""
    for work in trial.works:
        yield from list_work_values(work)
    yield from _list_values(RUNNING, trial, "")


def list_work_values(work: Work) -> Iterator[MetricValue]:
    """Yield all measurements of a piece of work."""
    match work:
        case WipingWork(wiping=wiping):
            yield from _list_values(WIPING, wiping, wiping.surface)
        case PolishingWork(wiping=wiping):
            yield from _list_values(POLISHING, work, wiping.surface)
            yield from _list_values(WIPING, wiping, wiping.surface)
        case PressingWork(button=button):
            yield from _list_values(PRESSING, work, button)
        case InsertingWork(socket=socket):
            yield from _list_values(INSERTING, work, socket)
        case TeachingWork(pose=pose):
            yield from _list_values(TEACHING, work, pose)
        case PlacingWork(thing=thing):
            yield from _list_values(PLACING, work, thing)
        case _:
            assert_never(work)


def _list_values(metrics: tuple[Metric[Result], ...], result: Result, subject: object) -> Iterator[MetricValue]:
    for metric in metrics:
        value = metric.of(result)
        if value is not None:
            yield MetricValue(metric, str(subject), value)


def _percent(part: float | None, whole: float | None) -> float | None:
    return None if part is None or whole is None else 100 * part / whole
