"""A report is there before its pictures, says so, and shows them when they are made; what is given up is in none."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from operating.monitors import Monitor
from skillc.services.recording import picture_making
from skillc.services.recording.picture_making import PictureOrder, Pictures, making_pictures
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.evaluation.report.figure import DrawnFigure, WorkFigure
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.write import ReportPages, write_page
from skillc_runtime.execution.worker_process import Died, Returned
from skillc_runtime.film.footage import FilmFiles
from skillc_runtime.film.rendering import RenderingError, check_rendering
from skillc_runtime.platforms.processes import DEFAULT_START
from skillc_runtime.recording.run_spec import RunSpec
from waiting import LONG_S

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RESULT = TaskResult(task="press", status="succeeded", sim_time_s=1.0)

CALL = "TakePosture(arm: lab:Panda-1)"


class Reporter(SilentReporter):
    """Records the messages that it gets."""

    def __init__(self) -> None:
        self.told: list[str] = []

    def say(self, message: str) -> None:
        self.told.append(message)


def run_in(folder: Path, pictures: Pictures) -> str:
    """Run a short task, and return its report as it is then."""
    spec = RunSpec(scene="panda_desk", call=CALL, backend="kinematic", out=str(folder), film_quality="draft")
    with load_task(spec, SilentReporter()) as loaded:
        assert run_task(loaded, RunOptions(spec), Monitor(), SilentReporter(), pictures).result.status == "succeeded"
    return page_of(folder)


def page_of(folder: Path) -> str:
    return (folder / "report.html").read_text(encoding="utf-8")


def draw_line() -> Figure:
    from matplotlib.figure import Figure

    figure = Figure()
    figure.subplots().plot([0, 1], [0, 1])
    return figure


def draw_for_ever() -> Figure:
    time.sleep(1000)
    raise AssertionError


def begin(pictures: Pictures, folder: Path, draw: Callable[[], Figure], footage: Any = None) -> None:
    """Write a report, and begin its figure, and a film if there is something to make one from."""
    figures, film = (WorkFigure("push", "Force", "Forces.", "Force over time", draw),), FilmFiles("film.mp4", (), 2)
    pages = ReportPages(RESULT, (), tuple(map(DrawnFigure, figures)), None if footage is None else film)
    write_page(folder, pages.begun)
    pictures.begin(PictureOrder("press", folder, figures, footage, pages))


def test_a_report_is_there_before_its_figures(tmp_path: Path) -> None:
    reporter = Reporter()
    with making_pictures(reporter) as pictures:
        begin(pictures, tmp_path, draw_line)
        before = page_of(tmp_path)
    assert "The figure is being drawn" in before and 'http-equiv="refresh"' in before and "<svg" not in before
    after = page_of(tmp_path)
    assert "<svg" in after and "being drawn" not in after and "refresh" not in after
    assert {each.name for each in tmp_path.iterdir()} == {"push.png", "push.svg", "report.html"}
    assert reporter.told == []


def test_figures_that_are_given_up_are_in_no_report_and_leave_no_process(tmp_path: Path) -> None:
    reporter = Reporter()
    with pytest.raises(KeyboardInterrupt), making_pictures(reporter) as pictures:
        begin(pictures, tmp_path, draw_for_ever)
        (making,) = pictures._making
        raise KeyboardInterrupt
    page = page_of(tmp_path)
    assert "being drawn" not in page and "refresh" not in page and "press" in page
    assert reporter.told == ["no figures: it was interrupted"]
    assert [each.name for each in tmp_path.iterdir()] == ["report.html"]
    assert isinstance(making.worker.poll(), Died)


def test_what_was_made_before_an_interrupt_stays(tmp_path: Path) -> None:
    reporter = Reporter()
    with pytest.raises(KeyboardInterrupt), making_pictures(reporter) as pictures:
        begin(pictures, tmp_path, draw_line)
        (making,) = pictures._making
        assert making.worker.wait(LONG_S) == Returned(None)
        (tmp_path / "report.html").write_text("with all", encoding="utf-8")
        raise KeyboardInterrupt
    assert page_of(tmp_path) == "with all" and reporter.told == []


def test_a_film_that_fails_leaves_the_figures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture_making, "FILM_START", DEFAULT_START)
    reporter = Reporter()
    with making_pictures(reporter) as pictures:
        begin(pictures, tmp_path, draw_line, footage="no footage")
        assert "The film is being made" in page_of(tmp_path)
    page = page_of(tmp_path)
    assert "<svg" in page and "<video" not in page and "being" not in page.partition("<body>")[2]
    assert len(reporter.told) == 1 and reporter.told[0].startswith("no film: AttributeError")


@pytest.mark.slow
def test_a_report_is_there_before_its_film(tmp_path: Path) -> None:
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    shares: list[float] = []
    with making_pictures(SilentReporter(), lambda _name, share: shares.append(share)) as pictures:
        before = run_in(tmp_path, pictures)
        assert "The film is being made" in before and 'http-equiv="refresh"' in before and "<video" not in before
    after = page_of(tmp_path)
    assert '<video controls src="film.mp4">' in after and "being made" not in after and "refresh" not in after
    assert (tmp_path / "film.mp4").stat().st_size > 1000
    assert shares == sorted(shares) and shares[-1] == 1.0


@pytest.mark.slow
def test_a_film_that_is_given_up_is_in_no_report(tmp_path: Path) -> None:
    reporter = Reporter()
    with pytest.raises(KeyboardInterrupt), making_pictures(reporter) as pictures:
        assert "The film is being made" in run_in(tmp_path, pictures)
        raise KeyboardInterrupt
    page = page_of(tmp_path)
    assert "being made" not in page and "<video" not in page and "TakePosture" in page
    assert reporter.told == ["no film: it was interrupted"] and not (tmp_path / "film.mp4").exists()
    assert not list(tmp_path.glob("*.part"))
