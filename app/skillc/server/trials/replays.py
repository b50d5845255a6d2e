"""Trials that are run again and recorded, so that they can be looked at."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skillc.contract.jobs import RecordTrial
from skillc.contract.trials import TrialReplay, TrialSeries
from skillc.server.simulation_jobs import SimulationJobs
from skillc.services.recording.recordings import RECORDING


@dataclass(frozen=True, slots=True)
class TrialReplays:
    """The trials that are run again, among the jobs of a server."""

    jobs: SimulationJobs

    def begin(self, series: TrialSeries, seed: int, scene: str, known: bytes) -> TrialReplay:
        """Run a trial again, once the jobs before it have ended; one that goes on, or has been recorded, is kept."""
        if (found := self.find(series.id, seed)) is not None and (found.state == "going on" or found.recording):
            return found
        self.jobs.begin(
            _name(series.id, seed), lambda folder: RecordTrial(series.request, scene, seed, str(folder)), known
        )
        return TrialReplay(series=series.id, seed=seed)

    def find(self, series: str, seed: int) -> TrialReplay | None:
        """Return how far a trial is that is run again; None if that was not requested, or it is forgotten."""
        outcome = self.jobs.find(_name(series, seed))
        if outcome is None:
            return None
        return TrialReplay(
            series=series,
            seed=seed,
            state="ended" if outcome.ended else "going on",
            reason=outcome.reason,
            result=outcome.result,
            recording=RECORDING in outcome.files,
        )

    def find_recording(self, series: str, seed: int) -> Path | None:
        """Return the recording of a trial that was run again; None if there is none."""
        return self.jobs.find_file(_name(series, seed), RECORDING)


def _name(series: str, seed: int) -> str:
    return f"trial-{series}-{seed}"
