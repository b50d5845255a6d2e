"""The evidence by which the work of a run is judged."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from skillc_model.conditions import Literal
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.metrics.intervals import subtract_intervals, total_s
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class RunEvidence:
    """The world model and the truth after a run, its history, and the rated wipings: the last one of each surface."""

    library: SkillLibrary
    state: WorldState
    truth: GroundTruth
    history: RunHistory
    wipings: tuple[tuple[Wiping, WipingResult], ...]

    def duration_share(self, subject: str) -> float | None:
        """Return the time of the last outermost call about an individual, relative to the duration of its skill.

        Pauses are left out.

        None if there is no such call, or its skill declares no constant duration.
        """
        for call in reversed(tuple(_outermost_calls(self.history.steps, subject))):
            literal = self.library.skills[call.skill].duration
            if isinstance(literal, Literal) and call.started is not None and call.ended is not None:
                taken = subtract_intervals([(call.started, call.ended)], self.history.paused)
                return total_s(taken) / float(literal.value)
        return None


def _outermost_calls(calls: Iterable[RecordedCall], subject: str) -> Iterator[RecordedCall]:
    for call in calls:
        if call.has_run and subject in call.individuals:
            yield call
        else:
            yield from _outermost_calls(call.calls, subject)
