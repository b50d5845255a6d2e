"""A report is there before its film, says so, and shows the film when it is made; one that is given up is in none."""

from __future__ import annotations

from pathlib import Path

import pytest

from operating.monitors import Monitor
from skillc.services.film_making import Films, making_films
from skillc.services.reporting import SilentReporter
from skillc.services.running import RunOptions, run_task
from skillc.services.task_loading import load_task
from skillc_runtime.film.rendering import RenderingError, check_rendering
from skillc_runtime.recording.run_spec import RunSpec

CALL = "TakePosture(arm: lab:Panda-1)"


class Reporter(SilentReporter):
    """Records the messages that it gets."""

    def __init__(self) -> None:
        self.told: list[str] = []

    def say(self, message: str) -> None:
        self.told.append(message)


def run_in(folder: Path, films: Films) -> str:
    """Run a short task, and return its report as it is then."""
    spec = RunSpec(scene="panda_desk", call=CALL, backend="kinematic", out=str(folder), film_quality="draft")
    with load_task(spec, SilentReporter()) as loaded:
        assert run_task(loaded, RunOptions(spec), Monitor(), SilentReporter(), films).result.status == "succeeded"
    return page_of(folder)


def page_of(folder: Path) -> str:
    return (folder / "report.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_a_report_is_there_before_its_film(tmp_path: Path) -> None:
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    shares: list[float] = []
    with making_films(SilentReporter(), lambda _name, share: shares.append(share)) as films:
        before = run_in(tmp_path, films)
        assert "The film is being made" in before and 'http-equiv="refresh"' in before and "<video" not in before
    after = page_of(tmp_path)
    assert '<video controls src="film.mp4">' in after and "being made" not in after and "refresh" not in after
    assert (tmp_path / "film.mp4").stat().st_size > 1000
    assert shares == sorted(shares) and shares[-1] == 1.0


@pytest.mark.slow
def test_a_film_that_is_given_up_is_in_no_report(tmp_path: Path) -> None:
    reporter = Reporter()
    with pytest.raises(KeyboardInterrupt), making_films(reporter) as films:
        assert "The film is being made" in run_in(tmp_path, films)
        raise KeyboardInterrupt
    page = page_of(tmp_path)
    assert "being made" not in page and "<video" not in page and "TakePosture" in page
    assert reporter.told == ["no film: it was interrupted"] and not (tmp_path / "film.mp4").exists()
    assert not list(tmp_path.glob("*.part"))
