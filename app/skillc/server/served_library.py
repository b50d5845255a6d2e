"""A library of a server: watched on disk, checked beside everything else, and given to the cells that use it."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import Sequence
from contextvars import Context, copy_context
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

from skillc.contract.messages import TakeLibrary
from skillc.server.library_stamp import KnownCode, Stamp, read_code, read_stamp
from skillc.server.log import log
from skillc.server.supervisor import CellSupervisor
from skillc.workers.library_check import CheckedLibrary, LibraryRefused, check_again, read_checked
from skillc_ontology import catalogue
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess
from skillc_runtime.platforms.python_modules import make_environment

POLL_S = 0.5
"""The interval at which the files are looked at; a change is checked once nothing has changed for so long."""
CHECK_S = 60.0
"""How long a check may take before its process is ended."""

LibraryAnswer: TypeAlias = CheckedLibrary | LibraryRefused


@dataclass(slots=True)
class ServedLibrary:
    """A library at `path`. `checked` is what the next operations run; `refused` is why what is on disk is not.

    `code` are its Python files, `stamp` is how its files were looked at last. `environment` are the
    variables of the processes of its cells; `ontologies` and `modules` are the folders where both are found. It is
    checked in the context `outside`, in which no other library is open. Who changes its files has the lock `writing`,
    and says that they are `touched`.
    """

    path: str
    checked: CheckedLibrary
    code: KnownCode
    stamp: Stamp
    environment: dict[str, str]
    ontologies: tuple[Path, ...]
    modules: tuple[str, ...]
    outside: Context
    refused: str = ""
    touched: bool = False
    checking: bool = False
    writing: asyncio.Lock = field(default_factory=asyncio.Lock, repr=False)
    _cancel: CancelToken = field(default_factory=CancelToken, repr=False)

    async def keep_up(self, cells: Sequence[CellSupervisor]) -> None:
        """Let cells have the library as it is on disk, whenever it has no errors, until this is cancelled."""
        seen = self.stamp
        try:
            while True:  # wait ends: with the server, which cancels it
                await asyncio.sleep(POLL_S)
                stamp = await asyncio.to_thread(read_stamp, self.checked.basis.folders)
                self.touched |= stamp != self.stamp
                if stamp == seen and self.touched:
                    self.stamp, self.touched, self.checking = stamp, False, True
                    await self._check()
                    self.checking = False
                seen = stamp
                await self._tell(cells)
        finally:
            self._cancel.cancel("the server ends")

    @property
    def pending(self) -> bool:
        """Whether its files have changed, and were not checked yet."""
        return self.touched or self.checking

    def find_obstacle(self) -> str:
        """Return why no cell may be started now: its code would be other than the server was started with."""
        return self.code.describe_changed(read_code(self.checked.basis.folders))

    async def _check(self) -> None:
        answer = await asyncio.to_thread(self.outside.run, self._ask)
        changed = await asyncio.to_thread(self.find_obstacle)
        if isinstance(answer, CheckedLibrary):
            self.checked = answer
        why = answer.why if isinstance(answer, LibraryRefused) else ""
        self.refused = "\n".join(filter(None, (why, changed)))
        log("library", path=self.path, hash=self.checked.hash, problem=self.refused)

    def _ask(self) -> LibraryAnswer:
        """Check the library in a process of its own; it is killed if it takes too long, or the server ends."""
        try:
            worker = WorkerProcess(check_again, "spawn")
        except OSError as error:
            return LibraryRefused(f"it cannot be checked: {error.strerror or error}")
        result = worker.answer((self.path, self.checked.basis), self._cancel.limited(CHECK_S))
        worker.kill()
        match result:
            case Returned(CheckedLibrary() | LibraryRefused() as answer):
                return answer
            case Raised(why) | Died(why):
                return LibraryRefused(f"its check has failed: {why}")
            case _:
                return LibraryRefused(f"its check took more than {CHECK_S:g} s, and was ended")

    async def _tell(self, cells: Sequence[CellSupervisor]) -> None:
        """Give cells what they do not have yet; one that is off gets it when it starts."""
        for each in cells:
            each.set_library(self.checked, self.refused)
            if each.ready and each.status.library_hash != self.checked.hash:
                await each.request(TakeLibrary(content=self.checked.content))


def open_library(path: Path, scenes: Sequence[Path]) -> ServedLibrary:
    """Read, check and note a library at the start of a server, as if there were no other.

    RequestError if there is none, DiagnosticsError if it has errors.
    """
    place = str(path.resolve() if path.exists() else path)
    before, outside = sys.path[:], copy_context()
    with catalogue.folder_scope():
        checked = read_checked(path, scenes)
        basis = checked.basis
        environment = {
            "PYTHONPATH": os.pathsep.join(str(Path(each).absolute()) for each in sys.path if each),
            catalogue.VARIABLE: os.pathsep.join(map(str, catalogue.user_folders())),
            **make_environment(basis.modules),
        }
        folders, added = catalogue.user_folders(), [each for each in sys.path if each not in before]
    sys.path[:] = before
    code, stamp = KnownCode.note(read_code(basis.folders)), read_stamp(basis.folders)
    return ServedLibrary(place, checked, code, stamp, environment, tuple(folders), tuple(added), outside)
