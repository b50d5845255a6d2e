"""`skillc diff`: what is not the same in two recordings, in the order of causes; equal ones say what was compared."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result
from msgspec import structs

from execution.test_repeat import recording
from operating.monitors import Monitor
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.run_diff.objective import compare_objectives
from skillc.services.tasks.loading import load_task
from skillc_dsl.position import Position
from skillc_model.conditions import And, Compare, Holds, Individual, Literal, Not, PropertyOf
from skillc_model.tree import Apply, Call, Node, Parallel, Selector, Sequence
from skillc_runtime.devices.disturbances import PushArm
from skillc_runtime.recording import commands
from skillc_runtime.recording.events import (
    FORMAT,
    Disturbed,
    Event,
    ImplementationChosen,
    PlanMade,
    Requested,
    TaskEnded,
    TaskStarted,
)
from skillc_runtime.recording.reasons import ParameterReason
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.signals.files import CsvSink, ParquetSink, write_dictionary
from skillc_runtime.recording.signals.signal import CLOCK, Signal
from skillc_runtime.world.state.labels.labelled import LabelledIri
from why.projects import invoke
from why.stories import written

FORCE = Signal(column="Arm/sensor/force_z_n", device="x", origin="sensor", unit="N", frame="", description="force")
HERE = Position("ask.skill", 1, 1)
LAB = "http://example.org/lab#"
Edit = Callable[[list[Event]], None]


def ask(individual: str) -> Call:
    return Call("Ask", None, {"of": Individual(individual)}, None, HERE)


def diff(*arguments: object) -> Result:
    return invoke("diff", *arguments)


def find_differences(folder: Path, edit: Edit) -> list[dict[str, Any]]:
    """Return the differences that an edit of a recording makes."""
    events = recording()
    written(folder / "a", events)
    edit(events)
    written(folder / "b", events)
    found: list[dict[str, Any]] = json.loads(diff(folder / "a", folder / "b", "--json").stdout)["differences"]
    return found


def change(kind: type[Event], number: int = 0, **fields: object) -> Edit:
    """Return an edit of one event."""

    def edit(events: list[Event]) -> None:
        place = [place for place, event in enumerate(events) if isinstance(event, kind)][number]
        events[place] = structs.replace(events[place], **fields)

    return edit


def bind_another(events: list[Event]) -> None:
    place = next(place for place, event in enumerate(events) if isinstance(event, ImplementationChosen))
    event = events[place]
    assert isinstance(event, ImplementationChosen) and event.bindings
    other = LabelledIri("http://example.org/x#z", "x:z")
    reason = ParameterReason(parameter="left", how="inferred")
    events[place] = structs.replace(
        event, bindings={**event.bindings, "left": other}, determined=(*event.determined, reason)
    )


def disturb(events: list[Event]) -> None:
    push = PushArm("http://example.org/x#arm", (0.0, 30.0, 0.0))
    events.insert(1, Disturbed(time=events[0].time, disturbance=push, tick=0, who="bo"))


def drop_last_step(events: list[Event]) -> None:
    place = next(place for place, event in enumerate(events) if isinstance(event, PlanMade))
    event = events[place]
    assert isinstance(event, PlanMade)
    events[place] = structs.replace(event, steps=event.steps[:-1])


@pytest.mark.parametrize(
    ("edit", "part", "what"),
    [
        (change(TaskStarted, seed=4), "settings", "seed"),
        (change(TaskStarted, hash="0123"), "settings", "library hash"),
        (change(Requested, command=commands.PauseRun("tea")), "requests", "request 1"),
        (change(Requested, 2, tick=99999), "requests", "request 3"),
        (disturb, "requests", "request 1"),
        (change(PlanMade, planner="guess"), "plan", "planner of plan 1"),
        (drop_last_step, "plan", "step 4"),
        (change(ImplementationChosen, implementation="other"), "choices", "1 "),
        (bind_another, "choices", "1 "),
        (change(TaskEnded, time=1e3), "times", "whole run"),
        (change(TaskEnded, status="failed", verified=None), "outcomes", "task"),
    ],
)
def test_the_first_difference_is_what_was_changed(tmp_path: Path, edit: Edit, part: str, what: str) -> None:
    first = find_differences(tmp_path, edit)[0]
    assert first["part"] == part and first["what"].startswith(what), first
    assert first["first"] != first["second"]


def test_goals_are_shown_in_the_syntax_of_the_language(tmp_path: Path) -> None:
    box, cup = (Individual(f"{LAB}{name}") for name in ("Box", "Cup"))
    sealed = Compare(PropertyOf(cup, "http://example.org/onto/parts#isSealed"), "==", Literal(True))
    goal = And((Holds(box, "http://example.org/skiros.owl#contain", cup), Not(sealed)))
    found = find_differences(tmp_path, change(TaskStarted, goal=goal))
    assert found[0]["what"] == "objective"
    assert found[0]["second"] == "Box contain Cup and (not Cup.isSealed == true)"


def test_calls_are_shown_as_an_author_writes_them(tmp_path: Path) -> None:
    body = Call("Ask", "by_operator", {"limit": Literal(3.0)}, None, HERE)
    found = find_differences(tmp_path, change(TaskStarted, goal=None, body=body))
    assert found[0]["what"] == "objective"
    assert found[0]["second"].startswith("Ask[by_operator](limit: 3")


@pytest.mark.parametrize(
    ("one", "other", "first", "second"),
    [
        (Sequence((), False, HERE), Sequence((), True, HERE), "seq", "reactive seq"),
        (Selector((), True, HERE), Selector((), False, HERE), "reactive sel", "sel"),
        (Parallel("all", (), HERE), Parallel("race", (), HERE), "par all", "par race"),
        (Apply(("seen",), HERE), Apply(("seen", "done"), HERE), "apply seen", "apply seen, done"),
        (Call("Look", None, {}, None, HERE), Call("Look", None, {}, "found", HERE), "Look()", "Look() -> found"),
        (ask(f"{LAB}Box"), ask(f"{LAB}Cup"), "Ask(of: Box)", "Ask(of: Cup)"),
        (ask(f"{LAB}Box"), ask("urn://own/Box"), f"Ask(of: {LAB}Box)", "Ask(of: urn://own/Box)"),
    ],
)
def test_nodes_that_differ_are_told_as_an_author_writes_them(one: Node, other: Node, first: str, second: str) -> None:
    starts = [TaskStarted(time=0.0, format=FORMAT, task="ask", library="own", body=each) for each in (one, other)]
    (told,) = compare_objectives(*starts)
    assert (told.first, told.second) == (first, second)


def test_a_run_differs_in_nothing_from_itself(tmp_path: Path) -> None:
    assert find_differences(tmp_path, lambda _: None) == []
    result = diff(tmp_path / "a", tmp_path / "b")
    assert result.exit_code == 0
    for part in ("settings (", "requests (", "plan (", "choices (", "outcomes (", "times ("):
        assert part in result.stdout
    assert result.stdout.startswith("no difference in ") and "signals" not in result.stdout
    assert "a has no signals to compare" in " ".join(result.stderr.split())


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_peaks_and_means_of_signals_are_compared(tmp_path: Path, form: str) -> None:
    find_differences(tmp_path, lambda _: None)
    forces = {"a": [0.0, -8.0, np.nan], "b": [0.0, -6.0, 1.0]}
    for name, values in forces.items():
        columns, file = (CLOCK, FORCE), tmp_path / name / f"signals.{form}"
        write_dictionary(tmp_path / name, file.name, columns, 0.01)
        sink = CsvSink(file, columns) if form == "csv" else ParquetSink(file, columns, 0.01)
        for number, value in enumerate(values):
            sink.write(np.array([number * 0.01, value]))
        sink.close()
    found = json.loads(diff(tmp_path / "a", tmp_path / "b", "--json").stdout)["differences"]
    assert {(each["part"], each["what"], each["first"], each["second"]) for each in found} == {
        ("signals", "Arm/sensor/force_z_n peak", 8.0, 6.0),
        ("signals", "Arm/sensor/force_z_n mean", -4.0, -5.0 / 3.0),
    }


def test_the_text_is_a_table_that_names_both_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    find_differences(Path(), change(TaskStarted, seed=4, backend="mujoco"))
    lines = [line.split() for line in diff("a", "b").stdout.splitlines()]
    assert lines == [["a", "b"], ["settings", "backend", "mujoco"], ["seed", "0", "4"]]


def test_what_cannot_be_read_is_an_error_of_one_sentence(tmp_path: Path) -> None:
    find_differences(tmp_path, lambda _: None)
    result = diff(tmp_path / "a", tmp_path / "nothing")
    assert result.exit_code == 1 and result.stderr.startswith("error: there is no folder")


@pytest.mark.sim
def test_signals_of_mcap_files_are_compared(tmp_path: Path) -> None:
    for seed in (1, 2):
        folder = str(tmp_path / str(seed))
        spec = RunSpec(task="contact:press_button", out=folder, seed=seed, backend="kinematic", film=False)
        with load_task(spec, SilentReporter()) as loaded:
            run_task(loaded, RunOptions(spec), Monitor(lambda run, now: ()), SilentReporter())
    result = diff(tmp_path / "1", tmp_path / "2/recording.mcap", "--json")
    found = json.loads(result.stdout)
    assert result.exit_code == 0 and found["compared"]["signals"] > 20 and not found["notes"]
    assert [each["what"] for each in found["differences"]] == ["seed"]
