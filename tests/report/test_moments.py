"""Stills are taken of what a run was about."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from msgspec import structs

from skillc_dsl.position import Position
from skillc_runtime.evaluation.report.film_story import find_moments
from skillc_runtime.film.footage import Moment
from skillc_runtime.recording.history.history import RecordedAttempt, RecordedCall, RunHistory
from skillc_runtime.recording.reasons import Highlight
from skillc_runtime.world.state.labels.labelled import LabelledIri

HERE = Position(path="press.skill", line=1, column=1)
STATE: Any = SimpleNamespace(instances=lambda _: {"http://lab#Arm"})
TRUTH: Any = SimpleNamespace()


BUTTON, HOLE = LabelledIri("http://lab#Button", "lab:Button"), LabelledIri("http://lab#Hole", "lab:Hole")
PRESSED = (Highlight("ends", BUTTON, "pressed"),)
FILLED = (Highlight("begins", HOLE, "found"), Highlight("ends", HOLE, "filled"))


def call(status: str, started: float | None, ended: float | None, *seen: Highlight) -> RecordedCall:
    return RecordedCall(
        number="1", skill="Work", status=status, source=HERE, implementation="x", started=started, ended=ended,
        bindings={"arm": LabelledIri("http://lab#Arm", "lab:Arm")}, highlights=seen,
    )  # fmt: skip


def history(status: str, *inner: RecordedCall) -> RunHistory:
    whole = structs.replace(call(status, 0.0, 9.0), calls=inner)
    return RunHistory(task="press", attempts=(RecordedAttempt(steps=(whole,)),))


def test_what_was_waited_for_is_seen_when_it_came() -> None:
    told = history("success", call("success", 3.0, 4.0, *PRESSED), call("success", 5.0, 6.0, *FILLED))
    assert find_moments((), told, STATE, TRUTH) == (
        Moment("Button pressed", 4.0, "http://lab#Arm"),
        Moment("Hole found", 5.0, "http://lab#Arm"),
        Moment("Hole filled", 6.0, "http://lab#Arm"),
    )


def test_stills_are_in_the_order_of_time_also_of_calls_in_parallel() -> None:
    told = history("success", call("success", 3.0, 8.0, *PRESSED), call("success", 5.0, 6.0, *FILLED))
    found = find_moments((), told, STATE, TRUTH)
    assert [each.title for each in found] == ["Hole found", "Hole filled", "Button pressed"]


def test_what_did_not_come_is_not_to_be_seen() -> None:
    told = history("failure", call("failure", 3.0, 4.0, *PRESSED), call("not started", None, None, *FILLED))
    assert find_moments((), told, STATE, TRUTH) == ()
