"""What a run has come to, by its events: times, failures of steps, outputs of its calls, and measures."""

from __future__ import annotations

from recording.runs import publish
from skillc_dsl.position import Position
from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted, StateChanged, TaskEnded, WorldChanged
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.account import MAX_LISTED, CallOutput, RunAccount
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledProperty, LabelledQuantity, LabelledValue

HERE = Position("play.skill", 1, 1)
DROPPED = Failure(kind="body", message="it fell", values={"force": LabelledQuantity(0.2, "N")})


def follow(*events: Event) -> RunAccount:
    account = RunAccount()
    publish(events, account)
    return account


def started(node: int, parent: int, kind: str = "call") -> NodeStarted:
    return NodeStarted(time=0.0, node=node, parent=parent, kind=kind, name="Weigh", source=HERE)


def ended(node: int, **outputs: LabelledValue) -> NodeEnded:
    return NodeEnded(time=1.0, node=node, name="Weigh", status="success", outputs=outputs, source=HERE)


def measured(name: str, value: float, known: Evidence | None, time: float) -> WorldChanged:
    thing, mass = LabelledIri(f"http://example.org/{name}", name), LabelledIri("http://example.org/mass", "mass")
    fact = LabelledProperty(thing, mass, LabelledQuantity(value, "kg"))
    return WorldChanged(time=time, origin="Weigh", changes=(fact,), known=known)


def state(now: str, failure: Failure | None = None) -> StateChanged:
    return StateChanged(time=0.0, state=now, failure=failure)  # type: ignore[arg-type]


def test_the_first_attempt_is_the_start_and_the_last_event_the_end() -> None:
    waiting = follow(state("planning"))
    assert waiting.started_at is None and waiting.ended_at is None
    going = follow(state("planning"), state("running"), state("paused"), state("running"))
    assert going.started_at is not None and going.ended_at is None
    over = follow(state("running"), TaskEnded(time=3.0, task="play", status="failed", failure=DROPPED))
    assert over.started_at is not None and over.ended_at is not None and over.started_at <= over.ended_at
    assert over.failure == DROPPED


def test_a_failure_is_known_while_somebody_has_to_decide_and_no_longer() -> None:
    assert follow(state("running"), state("paused", DROPPED)).failure == DROPPED
    assert follow(state("running"), state("paused", DROPPED), state("queued")).failure is None


def test_outputs_are_those_of_the_outermost_calls() -> None:
    nodes = (started(1, 0, "sequence"), started(2, 1), started(3, 2, "sequence"), started(4, 3), ended(4, mass=1))
    account = follow(*nodes, ended(3), ended(2, mass=2), started(5, 1), ended(5, mass=3), ended(1))
    assert account.outputs == (CallOutput("Weigh", 2, "mass", 2), CallOutput("Weigh", 5, "mass", 3))
    again = follow(*(each for node in range(1, 2 * MAX_LISTED) for each in (started(node, 0), ended(node, mass=node))))
    assert [each.node for each in again.outputs] == list(range(MAX_LISTED, 2 * MAX_LISTED))


def test_the_last_measure_of_each_property_counts_and_assumptions_do_not() -> None:
    account = follow(
        measured("crate", 1.0, "sensed", 1.0),
        measured("box", 2.0, "reported", 2.0),
        measured("crate", 1.5, "sensed", 3.0),
        measured("box", 9.0, "assumed", 4.0),
        measured("bin", 9.0, None, 5.0),
    )
    found = [(each.fact.individual.label, each.fact.value, each.known, each.time_s) for each in account.measures]
    assert found == [
        ("box", LabelledQuantity(2.0, "kg"), "reported", 2.0),
        ("crate", LabelledQuantity(1.5, "kg"), "sensed", 3.0),
    ]
