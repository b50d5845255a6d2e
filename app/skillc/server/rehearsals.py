"""The rehearsals of a server: what operations do in a simulated twin of a cell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from msgspec import structs

from skillc.contract.jobs import Rehearse
from skillc.contract.rehearsal import Rehearsal, RehearsalRequest
from skillc.server.simulation_jobs import SimulationJobs
from skillc.services.recording.recordings import RECORDING
from skillc_runtime.recording.envelope import make_run_id

FILM = "film.mp4"


@dataclass(frozen=True, slots=True)
class Rehearsals:
    """The rehearsals among the jobs of a server."""

    jobs: SimulationJobs
    _begun: dict[str, Rehearsal] = field(default_factory=dict)

    def begin(self, cell: str, request: RehearsalRequest, twin: bytes) -> Rehearsal:
        """Rehearse a request in a twin from an encoded snapshot of a cell, once the jobs before it have ended."""
        begun = Rehearsal(id=make_run_id(request.task or "rehearsal"), cell=cell, request=request)
        self._begun[begun.id] = begun
        self.jobs.begin(begun.id, lambda folder: Rehearse(request, str(folder)), twin)
        return begun

    def list(self, cell: str) -> tuple[Rehearsal, ...]:
        """Return the rehearsals for a cell, the first one first."""
        return tuple(each for each in self._known() if each.cell == cell)

    def find(self, name: str) -> Rehearsal | None:
        """Return a rehearsal by its id; None if there is none such."""
        begun, outcome = self._begun.get(name), self.jobs.find(name)
        if begun is None or outcome is None:
            self._begun.pop(name, None)
            return None
        if not outcome.ended:
            return begun
        film, recording = FILM in outcome.files, RECORDING in outcome.files
        return structs.replace(
            begun, state="ended", reason=outcome.reason, result=outcome.result, film=film, recording=recording
        )

    def find_film(self, name: str) -> Path | None:
        """Return the film of a rehearsal; None if there is none."""
        return self.jobs.find_file(name, FILM)

    def find_recording(self, name: str) -> Path | None:
        """Return the recording of a rehearsal; None if there is none."""
        return self.jobs.find_file(name, RECORDING)

    def remove(self, name: str) -> None:
        """End and forget a rehearsal."""
        del self._begun[name]
        self.jobs.remove(name)

    def _known(self) -> Iterator[Rehearsal]:
        for name in tuple(self._begun):
            if (found := self.find(name)) is not None:
                yield found
