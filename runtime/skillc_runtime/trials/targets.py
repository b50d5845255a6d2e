"""What good wiping is: the metrics of a trial and the targets that each trial, or half of them, must meet."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from skillc_runtime.report.result import WipingResult
from skillc_runtime.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class Metric:
    """A number of one wiping, in `unit`; None where it was not measured.

    It shall be `sense` the `target` in every trial, and the median of all trials the `median_target`, if there is one.
    """

    name: str
    unit: str
    of: Callable[[WipingResult], float | None]
    sense: Literal["at least", "at most"]
    target: float | None = None
    median_target: float | None = None

    def met(self, value: float) -> bool:
        """Tell whether a value is as good as the target."""
        if self.target is None:
            return True
        return value >= self.target if self.sense == "at least" else value <= self.target

    @property
    def wanted(self) -> str:
        """The target in words."""
        if self.target is None:
            return "no target"
        return f"{self.sense} {self.target:g} {self.unit}"


METRICS = (
    Metric("coverage", "%", lambda w: 100 * w.coverage, "at least", 100.0),
    Metric("mean force error", "%", lambda w: 100 * abs(w.force_mean_n / w.force_command_n - 1), "at most", 2.0),
    Metric("force RMSE", "% of F", lambda w: 100 * w.force_rmse_n / w.force_command_n, "at most", 10.0, 5.0),
    Metric("contact lost", "%", lambda w: 100 * w.contact_lost, "at most", 0.0),
    Metric("first impact", "x F", lambda w: w.first_impact_n / w.force_command_n, "at most", 2.0),
    Metric("vibration", "mm/s", lambda w: w.vibration_mm_s, "at most", 1.0),
    Metric("tilt", "deg rms", lambda w: w.tilt_rms_deg, "at most", 0.5),
    Metric("tracking", "mm rms", lambda w: w.tracking_rms_mm, "at most"),
    Metric("lane-end dwell", "s", lambda w: w.lane_dwell_s, "at most", 0.02),
)


@dataclass(frozen=True, slots=True)
class Value:
    """A metric of one surface in one trial."""

    metric: Metric
    surface: str
    value: float


def values(trial: Trial) -> Iterator[Value]:
    """Yield everything that was measured of the wiping in a trial."""
    for wiping in trial.wipings:
        for metric in METRICS:
            value = metric.of(wiping)
            if value is not None:
                yield Value(metric, wiping.surface, value)
