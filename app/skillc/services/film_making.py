"""Makes the films of runs beside this process: the report is there before, and says that its film is being made."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, TypeAlias

from skillc.services.reporting import Reporter
from skillc_runtime.evaluation.report.write import write_page
from skillc_runtime.execution.worker_process import ReportingFunction, Returned, WorkerProcess, WorkerResult
from skillc_runtime.platforms.processes import DEFAULT_START

if TYPE_CHECKING:
    from skillc_runtime.film.footage import Footage

LOOK_S = 0.25
"""How often a film is looked for that is being made, in s."""

START = "spawn" if DEFAULT_START == "fork" else DEFAULT_START
"""GL libraries that this process has used do not work in a fork of it."""

ShowProgress: TypeAlias = Callable[[str, float], None]
"""Shows the progress of a film: arguments are the name of its task and the share that is done."""


def no_progress(_name: str, _share: float) -> None:
    """Show nothing."""


@dataclass(frozen=True, slots=True)
class FilmOrder:
    """A film to make into the folder of a report, and the page of the report with it, and without one."""

    name: str
    folder: Path
    footage: Footage
    page: str
    page_without: str


@dataclass(slots=True)
class _Making:
    """A film that a process makes."""

    order: FilmOrder
    worker: WorkerProcess


@dataclass(slots=True)
class Films:
    """The films that are being made, by a process each."""

    reporter: Reporter
    _private: Path
    _making: list[_Making] = field(default_factory=list)

    def begin(self, order: FilmOrder) -> None:
        """Begin to make a film; without a process that does, the report is one without a film."""
        try:
            request = self._private / f"{len(self._making)}.film"
            request.write_bytes(pickle.dumps((order.footage, order.folder, order.page)))
            worker = WorkerProcess(ReportingFunction(_make), START)
        except OSError as error:
            self._give_up(order, f"no process can be started that makes it: {error.strerror or error}")
            return
        worker.ask(request)
        self._making.append(_Making(order, worker))

    def wait(self, show: ShowProgress) -> None:
        """Wait until all films are made."""
        for each in self._making:
            while (result := each.worker.wait(LOOK_S)) is None:
                show(each.order.name, each.worker.report or 0.0)
            show(each.order.name, 1.0)
            each.worker.kill()
            self._end(each.order, result)
        self._making.clear()

    def close(self) -> None:
        """End what is not made."""
        for each in self._making:
            each.worker.kill()
            self._give_up(each.order, "it was interrupted")
        self._making.clear()

    def _end(self, order: FilmOrder, result: WorkerResult) -> None:
        match result:
            case Returned(None):
                pass
            case Returned(str() as why):
                self._give_up(order, why)
            case Returned(value):
                raise TypeError(f"making a film returned {value!r}")
            case failed:
                self._give_up(order, failed.why)

    def _give_up(self, order: FilmOrder, why: str) -> None:
        self.reporter.say(f"no film: {why}")
        with suppress(OSError):  # the report cannot be written any more, and that is said where it is
            write_page(order.folder, order.page_without)


@contextmanager
def making_films(reporter: Reporter, show: ShowProgress = no_progress) -> Iterator[Films]:
    """Yield what makes films beside this process, in a `with` statement, which ends when they are made.

    If the block raises, films that are not made are given up.
    """
    with TemporaryDirectory(prefix="skillc-films-", ignore_cleanup_errors=True) as private:
        films = Films(reporter, Path(private))
        try:
            yield films
            films.wait(show)
        finally:
            films.close()


def _make(request: Path, report: Callable[[float], None]) -> str | None:
    """Make a film and write the page of its report; return why that is not possible, in this process or another one."""
    from skillc_runtime.film.picture_files import FilmError
    from skillc_runtime.film.render_film import render_film
    from skillc_runtime.film.rendering import RenderingError

    footage, folder, page = pickle.loads(request.read_bytes())
    try:
        render_film(footage, folder, report)
        write_page(folder, page)
    except (FilmError, RenderingError) as error:
        return str(error)
    except OSError as error:
        return f"{folder} cannot be written to: {error.strerror or error}"
    return None
