"""In a symbolic cell skills act by what they declare: after their duration, with holds and locks, as assumptions."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.declared import act_as_declared
from skillc_ontology import catalogue
from skillc_runtime.backends.symbolic.cell import SymbolicCell
from skillc_runtime.recording.events import Event, NodeEnded, WorldChanged
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import DEVICE_STATE
from symbolic.ward import compile_ward, run_body, run_in_cell

LAB = "http://example.org/lab#"
CONTAIN = "http://rvmi.aau.dk/ontologies/skiros.owl#contain"
OWN = "https://w3id.org/skillc/library/ward#"


def test_time_passes_from_event_to_event(tmp_path: Path) -> None:
    events: list[Event] = []
    execution = run_body(tmp_path, "Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen)", [events.append])
    assert execution.status == "succeeded" and execution.verified is False
    assert execution.backend.now == pytest.approx(20.0, abs=0.05)
    ended = [each for each in events if isinstance(each, NodeEnded) and each.name == "Carry[by_itself]"]
    assert [each.time for each in ended] == [pytest.approx(20.0, abs=0.02)]
    assert [each.origin for each in events if isinstance(each, WorldChanged)] == ["Carry"]
    assert {each.known for each in execution.facts} == {"assumed"}
    assert execution.backend.world.snapshot().holds(f"{LAB}Kitchen", CONTAIN, f"{LAB}Tray-1")


def test_a_skill_without_implementation_acts_too_and_a_plan_is_followed(tmp_path: Path) -> None:
    library = compile_ward(tmp_path)
    execution = run_in_cell(library, "deliver", tmp_path / "ward" / "ward.ttl")
    assert execution.status == "succeeded"
    assert execution.backend.now == pytest.approx(50.0, abs=0.2)


def test_sensed_posts_are_idealised_and_outputs_stand_in(tmp_path: Path) -> None:
    execution = run_body(
        tmp_path,
        "seq { Feel(tray: lab:Tray-2) -> place Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: place) }",
    )
    assert execution.status == "succeeded", execution.failure
    state = execution.backend.world.snapshot()
    assert state.holds(f"{LAB}Ward-2", CONTAIN, f"{LAB}Tray-1"), "the place of the tray is the output"
    assert state.value(f"{LAB}Tray-2", f"{OWN}isWarm") is True
    assert state.value(f"{LAB}Tray-2", f"{OWN}fill") == 0.0
    assert {each.known for each in execution.facts} == {"assumed", "idealised"}


def test_an_endless_skill_goes_on_until_it_is_halted(tmp_path: Path) -> None:
    execution = run_body(tmp_path, "par lead { wait 90 s  Hum(cart: lab:Cart-1) }")
    assert execution.status == "succeeded"
    assert execution.backend.now == pytest.approx(90.0, abs=0.05)


@pytest.mark.parametrize(("limit", "status"), [("19 s", "failed"), ("20 s", "succeeded")])
def test_what_is_late_fails_and_what_ends_just_then_is_in_time(tmp_path: Path, limit: str, status: str) -> None:
    call = "Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen)"
    execution = run_body(tmp_path, f"timeout {limit} {{ {call} }}")
    assert execution.status == status
    assert execution.backend.now == pytest.approx(float(limit.split()[0]), abs=0.05)
    moved = execution.backend.world.snapshot().holds(f"{LAB}Kitchen", CONTAIN, f"{LAB}Tray-1")
    assert moved == (status == "succeeded"), "stopped half way, it does nothing"


def test_preconditions_and_holds_count(tmp_path: Path) -> None:
    away = run_body(tmp_path, "Carry(cart: lab:Cart-1, tray: lab:Tray-2, to: lab:Kitchen)")
    assert away.failure is not None and "no answer for `cart at from`" in away.failure.message

    def break_down(cell: SymbolicCell) -> None:
        if cell.now > 4.0:
            cell.world.commit([SetProperty(f"{LAB}Cart-1", DEVICE_STATE, "Fault")], "somebody", "assumed")

    body = "par all { Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen)  wait 5 s }"
    broken = run_body(tmp_path, body, after_tick=break_down)
    assert broken.failure is not None and broken.failure.kind == "hold"
    assert broken.backend.now == pytest.approx(5.0, abs=0.05)


TASKS = (
    ("wiping", "clean_table"),
    ("wiping", "share_eraser"),
    ("contact", "insert_peg"),
    ("contact", "press_button"),
    ("sorting", "sort_parts"),
)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "task"), TASKS)
def test_shipped_tasks_run_without_bodies(name: str, task: str) -> None:
    compiled = compile_valid(find_library(SHIPPED / name))
    library, scene = act_as_declared(compiled), compiled.tasks[task].scene
    assert scene is not None
    beside = SHIPPED / name / scene
    execution = run_in_cell(library, task, beside if beside.exists() else catalogue.scene_path(scene))
    assert execution.status == "succeeded", execution.failure
    assert library.hash == compiled.hash
