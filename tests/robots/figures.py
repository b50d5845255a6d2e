"""How well a task was done, measured as in the report of a simulation: one row of the table of bodies."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, ClassVar

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.metrics.wiping import measure_wiping
from skillc_runtime.evaluation.report.handlings import find_handlings, find_targets, measure_placements
from skillc_runtime.evaluation.report.wiping import find_wipings, wiping_setup
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import BUTTON


@dataclass(frozen=True, slots=True)
class Figures:
    """The figures of one task in one body; None for what was not measured.

    outcome: "succeeded", or why not. Of a wiping: coverage, mean error and RMSE of the force as shares of the command,
    greatest and rms tilt in degrees, share of the time without contact; met_n: the greatest force outside the strokes,
    when the tool meets the surface. pressed_n: the greatest force on a button. missed_mm: how far what was put down is
    from where it should be. lost: cycles without command or state, of so many. violations: commands beyond the limits
    of the maker.
    """

    HEAD: ClassVar = (
        "| task | body | outcome | time (s) | coverage | mean error | RMSE | tilt max/rms (deg) | contact lost "
        "| met with (N) | pressed (N) | missed (mm) | lost cycles | beyond limits |\n" + "|---" * 14 + "|"
    )

    outcome: str
    seconds: float
    coverage: float | None = None
    mean_error: float | None = None
    rmse: float | None = None
    tilt_max_deg: float | None = None
    tilt_rms_deg: float | None = None
    contact_lost: float | None = None
    met_n: float | None = None
    pressed_n: float | None = None
    missed_mm: float | None = None
    lost: int | None = None
    cycles: int | None = None
    violations: int | None = None

    def with_cycles(self, lost: int, cycles: int, violations: int) -> Figures:
        """Return it with what was counted of cycles and commands."""
        return replace(self, lost=lost, cycles=cycles, violations=violations)

    def as_row(self, task: str, body: str) -> str:
        """Return it as a row of the table."""
        tilt = "" if self.tilt_max_deg is None else f"{self.tilt_max_deg:.2f}/{self.tilt_rms_deg:.2f}"
        lost = "" if self.lost is None else f"{self.lost} of {self.cycles}"
        cells = [
            self.outcome,
            f"{self.seconds:.1f}",
            *map(_percent, (self.coverage, self.mean_error, self.rmse)),
            tilt,
            _percent(self.contact_lost),
            *("" if each is None else f"{each:.1f}" for each in (self.met_n, self.pressed_n, self.missed_mm)),
            lost,
            "" if self.violations is None else str(self.violations),
        ]
        return self.row(task, body, *cells)

    @staticmethod
    def row(*cells: str) -> str:
        """Return a row of the table; cells that are not given are empty."""
        texts = [*cells, *[""] * (14 - len(cells))]
        return f"| {' | '.join(each.replace('|', '/') for each in texts)} |"


def measure(execution: Any, history: RunHistory, truth: GroundTruth | None) -> Figures:
    """Return the figures of a task that was carried out; without `truth` only how it ended."""
    failure = execution.failure
    outcome = execution.status if failure is None else f"{execution.status}: {describe_failure(failure)}"
    figures, world = Figures(outcome, history.last), execution.backend.cell.world
    if truth is None:
        return figures
    found = _measure_wiping(world, history, truth) | _measure_placing(world, history, truth)
    return replace(figures, **found, **_measure_pressing(world, truth))


def _measure_wiping(world: WorldModel, history: RunHistory, truth: GroundTruth) -> dict[str, Any]:
    state = world.snapshot()
    wipings = find_wipings(history, state)
    if not wipings:
        return {}
    wiping = wipings[0]
    recording = truth.recording(wiping.tool).between(wiping.began, wiping.end)
    found = measure_wiping(recording, wiping.strokes, wiping_setup(wiping, state, truth), wiping.pauses)
    return {
        "coverage": found.coverage,
        "mean_error": abs(found.force_mean_n / found.force_command_n - 1.0),
        "rmse": found.force_rmse_n / found.force_command_n,
        "tilt_max_deg": found.tilt_max_deg,
        "tilt_rms_deg": found.tilt_rms_deg,
        "contact_lost": found.contact_lost,
        "met_n": found.first_impact_n,
    }


def _measure_placing(world: WorldModel, history: RunHistory, truth: GroundTruth) -> dict[str, Any]:
    targets = find_targets(find_handlings(history, world.snapshot()))
    missed = [each.missed_m for each in measure_placements(world, truth, targets) if each.missed_m is not None]
    return {"missed_mm": 1e3 * max(missed)} if missed else {}


def _measure_pressing(world: WorldModel, truth: GroundTruth) -> dict[str, Any]:
    buttons = sorted(world.snapshot().instances(BUTTON))
    forces = [rows[:, 1].max() for each in buttons if len(rows := truth.pressing(each))]
    return {"pressed_n": float(max(forces))} if forces else {}


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100 * share:.2f} %"
