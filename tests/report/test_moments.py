"""Stills are taken of what a run was about."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.evaluation.report.moments import find_moments
from skillc_runtime.film.film import Moment
from skillc_runtime.recording.events import Highlight, ImplementationChosen
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.state.labelled import LabelledIri

HERE = Position(path="press.skill", line=1, column=1)
STATE: Any = SimpleNamespace(instances=lambda _: {"http://lab#Arm"})
TRUTH: Any = SimpleNamespace()


def call(number: int, status: str, started: float | None, ended: float | None, *below: NodeOutcome) -> NodeOutcome:
    return NodeOutcome(
        id=number, name="", kind="call", status=status, source=HERE, started=started, ended=ended, children=below
    )


def chosen(node: int, what: LabelledIri, *seen: tuple[str, str]) -> ImplementationChosen:
    return ImplementationChosen(
        time=0.0,
        node=node,
        skill="Work",
        implementation="x",
        bindings={"arm": LabelledIri("http://lab#Arm", "lab:Arm"), "what": what},
        highlights=tuple(Highlight(when, what, word) for when, word in seen),
        rejected=(),
        source=HERE,
    )


CHOICES = {
    2: chosen(2, LabelledIri("http://lab#Button", "lab:Button"), ("ends", "pressed")),
    3: chosen(3, LabelledIri("http://lab#Hole", "lab:Hole"), ("begins", "found"), ("ends", "filled")),
}


def test_what_was_waited_for_is_seen_when_it_came() -> None:
    tree = call(1, "success", 0.0, 9.0, call(2, "success", 3.0, 4.0), call(3, "success", 5.0, 6.0))
    assert find_moments((), [tree], CHOICES, STATE, TRUTH) == (
        Moment("Button pressed", 4.0, "http://lab#Arm"),
        Moment("Hole found", 5.0, "http://lab#Arm"),
        Moment("Hole filled", 6.0, "http://lab#Arm"),
    )


def test_what_did_not_come_is_not_to_be_seen() -> None:
    tree = call(1, "failure", 0.0, 9.0, call(2, "failure", 3.0, 4.0), call(3, "idle", None, None))
    assert find_moments((), [tree], CHOICES, STATE, TRUTH) == ()
