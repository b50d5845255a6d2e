"""Makes figures and films of reports beside this process: a report is there before, and says what is being made."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from skillc.services.reporting.reporter import Reporter
from skillc_runtime.execution.worker_process import ReportingFunction, Returned, WorkerProcess, WorkerResult
from skillc_runtime.platforms.processes import DEFAULT_START

if TYPE_CHECKING:
    from skillc_runtime.evaluation.report.figure import WorkFigure
    from skillc_runtime.evaluation.report.write import ReportPages
    from skillc_runtime.film.footage import Footage

LOOK_S = 0.25
"""How often a film is looked for that is being made, in s."""

FILM_START = "spawn" if DEFAULT_START == "fork" else DEFAULT_START
"""GL libraries that this process has used do not work in a fork of it."""

ShowProgress: TypeAlias = Callable[[str, float], None]
"""Shows the progress of a film: arguments are the name of its task and the share that is done."""


def no_progress(_name: str, _share: float) -> None:
    """Show nothing."""


class PictureOrder(msgspec.Struct, frozen=True):
    """Figures to draw, and a film to make unless `footage` is None, into the folder of a report with these pages."""

    name: str
    folder: Path
    figures: Sequence[WorkFigure]
    footage: Footage | None
    pages: ReportPages


class _Making(msgspec.Struct, frozen=True):
    """An order that a process carries out; `spare` is the folder of the page that is shown if there is no film."""

    order: PictureOrder
    spare: Path
    worker: WorkerProcess


@dataclass(slots=True)
class Pictures:
    """The pictures of reports that are being made, by a process for each report."""

    reporter: Reporter
    _private: Path
    _making: list[_Making] = field(default_factory=list)

    def begin(self, order: PictureOrder) -> None:
        """Begin to make pictures; without a process that does, the report is one without them."""
        spare = self._private / str(len(self._making))
        try:
            spare.mkdir()
            request = spare / "request"
            request.write_bytes(pickle.dumps((order, spare)))
            worker = WorkerProcess(ReportingFunction(_make), DEFAULT_START if order.footage is None else FILM_START)
        except OSError as error:
            self._give_up(order, spare, f"no process can be started that makes it: {error.strerror or error}")
            return
        worker.ask(request)
        self._making.append(_Making(order, spare, worker))

    def wait(self, show: ShowProgress) -> None:
        """Wait until all pictures are made; `show` gets the progress of films."""
        for each in self._making:
            shown = no_progress if each.order.footage is None else show
            while (result := each.worker.wait(LOOK_S)) is None:
                shown(each.order.name, each.worker.report or 0.0)
            shown(each.order.name, 1.0)
            each.worker.kill()
            self._end(each, result)
        self._making.clear()

    def close(self) -> None:
        """End what is not made; what was made by now stays."""
        for each in self._making:
            each.worker.kill()
            match each.worker.poll():
                case Returned() as result:
                    self._end(each, result)
                case _:
                    self._give_up(each.order, each.spare, "it was interrupted")
        self._making.clear()

    def _end(self, making: _Making, result: WorkerResult) -> None:
        match result:
            case Returned(None):
                pass
            case Returned(str() as why):
                self._give_up(making.order, making.spare, why)
            case Returned(value):
                raise TypeError(f"making pictures returned {value!r}")
            case failed:
                self._give_up(making.order, making.spare, failed.why)

    def _give_up(self, order: PictureOrder, spare: Path, why: str) -> None:
        """Say what is not made, and write the page without it."""
        from skillc_runtime.evaluation.report.write import read_page, write_page

        page = read_page(spare)
        missing = [*(["figures"] if page is None and order.figures else []), *(["film"] if order.footage else [])]
        if missing:
            self.reporter.say(f"no {' and no '.join(missing)}: {why}")
        with suppress(OSError):  # the report cannot be written any more, and that is said where it is
            write_page(order.folder, page or order.pages.without_film)


@contextmanager
def making_pictures(reporter: Reporter, show: ShowProgress = no_progress) -> Iterator[Pictures]:
    """Yield what makes pictures beside this process, in a `with` statement, which ends when they are made.

    If the block raises, pictures that are not made are given up.
    """
    with TemporaryDirectory(prefix="skillc-pictures-", ignore_cleanup_errors=True) as private:
        pictures = Pictures(reporter, Path(private))
        try:
            yield pictures
            pictures.wait(show)
        finally:
            pictures.close()


def _make(request: Path, report: Callable[[float], None]) -> str | None:
    """Make pictures and write the page of their report; return why that is not possible."""
    order, spare = pickle.loads(request.read_bytes())
    try:
        return _draw(order, spare, report)
    except OSError as error:
        return f"{order.folder} cannot be written to: {error.strerror or error}"


def _draw(order: PictureOrder, spare: Path, report: Callable[[float], None]) -> str | None:
    """Draw the figures, then the film; after each the page shows what there is. Return why there is no film."""
    from skillc_runtime.evaluation.report.write import write_figures, write_page

    pages = order.pages.with_figures(write_figures(order.folder, order.figures))
    write_page(spare, pages.without_film)
    write_page(order.folder, pages.without_film if order.footage is None else pages.begun)
    if order.footage is None:
        return None
    from skillc_runtime.film.picture_files import FilmError
    from skillc_runtime.film.render_film import render_film
    from skillc_runtime.film.rendering import RenderingError

    try:
        render_film(order.footage, order.folder, report)
    except (FilmError, RenderingError) as error:
        return str(error)
    write_page(order.folder, pages.with_film)
    return None
