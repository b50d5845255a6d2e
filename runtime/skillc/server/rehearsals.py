"""The rehearsals of a server: what operations do in a simulated twin of a cell, one at a time."""

from __future__ import annotations

import asyncio
import shutil
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import msgspec
from msgspec import structs

from skillc.services.recordings import RECORDING
from skillc.workers.jobs import RehearsalRequest, Rehearse
from skillc.workers.pool import JobFailed, JobTimedOut, TooManyJobs, Workers
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.recording.envelope import make_run_id

LIMIT_S = 900.0
"""How long a rehearsal may take, in s of wall time."""
MAX_WAITING, MAX_ENDED = 8, 20
"""How many rehearsals may wait or go on, and of how many that have ended the results are kept."""
FILM = "film.mp4"


class Rehearsal(msgspec.Struct, frozen=True, kw_only=True):
    """A rehearsal of a request in a twin of a cell, as the cell was when it was requested.

    `result` is null until it has ended, and then if the request could not be carried out: `reason` says why. `film`
    and `recording` are whether there is one.
    """

    id: str
    cell: str
    request: RehearsalRequest
    state: Literal["going on", "ended"] = "going on"
    reason: str = ""
    result: TaskResult | None = None
    film: bool = False
    recording: bool = False


@dataclass(slots=True)
class Rehearsals:
    """The rehearsals in a folder, which is emptied: they end with the server."""

    folder: Path
    _workers: Workers = field(default_factory=lambda: Workers(count=1, turn_s=MAX_WAITING * LIMIT_S))
    _known: dict[str, Rehearsal] = field(default_factory=dict)
    _tasks: dict[str, asyncio.Task[None]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)

    @property
    def full(self) -> bool:
        """Whether no more are taken now."""
        return len(self._tasks) >= MAX_WAITING

    def begin(self, cell: str, request: RehearsalRequest, twin: bytes) -> Rehearsal:
        """Rehearse a request in a twin from an encoded snapshot of a cell, once those before it have ended."""
        begun = Rehearsal(id=make_run_id(request.task or "rehearsal"), cell=cell, request=request)
        self._known[begun.id] = begun
        self._tasks[begun.id] = asyncio.create_task(self._rehearse(begun, twin))
        ended = [each for each in self._known if each not in self._tasks]
        for each in ended[:-MAX_ENDED]:
            self.remove(each)
        return begun

    def list(self, cell: str) -> tuple[Rehearsal, ...]:
        """Return the rehearsals for a cell, the first one first."""
        return tuple(each for each in self._known.values() if each.cell == cell)

    def find(self, name: str) -> Rehearsal | None:
        """Return a rehearsal by its id; None if there is none such."""
        return self._known.get(name)

    def find_film(self, name: str) -> Path | None:
        """Return the film of a rehearsal; None if there is none."""
        found = self._known.get(name)
        return self.folder / name / FILM if found is not None and found.film else None

    def find_recording(self, name: str) -> Path | None:
        """Return the recording of a rehearsal; None if there is none."""
        found = self._known.get(name)
        return self.folder / name / RECORDING if found is not None and found.recording else None

    def remove(self, name: str) -> None:
        """End and forget a rehearsal."""
        self._known.pop(name, None)
        if (task := self._tasks.pop(name, None)) is not None:
            task.cancel()
        else:
            self._clear(name)

    def close(self) -> None:
        """End all rehearsals."""
        for each in tuple(self._known):
            self.remove(each)
        self._workers.close()
        with suppress(OSError):
            self.folder.rmdir()

    async def _rehearse(self, begun: Rehearsal, twin: bytes) -> None:
        folder = self.folder / begun.id
        job = Rehearse(begun.request, str(folder))
        result, reason = None, ""
        try:
            result = await self._workers.answer(job, twin, TaskResult, LIMIT_S)
        except (JobFailed, JobTimedOut, TooManyJobs) as error:
            reason = str(error)
        except asyncio.CancelledError:
            self._clear(begun.id)
            raise
        film, recording = (folder / FILM).exists(), (folder / RECORDING).exists()
        ended = structs.replace(begun, state="ended", result=result, reason=reason, film=film, recording=recording)
        self._known[begun.id] = ended
        del self._tasks[begun.id]

    def _clear(self, name: str) -> None:
        shutil.rmtree(self.folder / name, ignore_errors=True)
