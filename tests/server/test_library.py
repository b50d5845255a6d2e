"""What a cell can do, by its API: skills, tasks, devices and which operation holds them."""

from __future__ import annotations

import os
import signal
from importlib.metadata import version
from pathlib import Path

import pytest

import skillc
from server.running import RunningServer, find_cell_process
from skillc.cells.snapshot import CellSnapshot, decode_snapshot, encode_snapshot
from skillc.contract.device import SheetFigure
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library, find_scene
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import load_world
from skillc.workers.devices import list_devices
from skillc.workers.library_check import describe_library


def test_skills_and_tasks_are_described(server: RunningServer) -> None:
    found = server.client.get("/cells/yard/library").json()
    assert found["hash"] == server.client.get("/cells/yard").json()["library_hash"]
    load = next(each for each in found["skills"] if each["name"] == "Load")
    assert load["pre"] == ["from contain crate", "not cart contain _", "from != cart"]
    assert [(each["name"], each["direction"], each["type"]) for each in load["parameters"]] == [
        ("cart", "in", "lab:Cart"),
        ("crate", "in", "skiros:Product"),
        ("from", "infer", "skiros:Location"),
    ]
    assert [each["name"] for each in load["implementations"]] == ["by_hand"]
    assert load["duration_s"] is None
    tasks = {each["name"]: each for each in found["tasks"]}
    assert list(tasks) == ["carry", "carry_all", "carry_two", "confirm"]
    assert (tasks["carry"]["doc"], tasks["carry"]["goal"]) == ("Bring one crate to a place.", "to contain crate")


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="stops a process")
def test_the_description_is_kept_and_asks_neither_the_cell_nor_a_worker(server: RunningServer) -> None:
    cell = find_cell_process(server)
    os.kill(cell, signal.SIGSTOP)
    try:
        found = server.client.get("/cells/yard/library")
    finally:
        os.kill(cell, signal.SIGCONT)
    assert found.status_code == 200 and {each["name"] for each in found.json()["skills"]} >= {"Load", "Unload"}


def test_workers_read_a_library_once_whatever_the_world_is() -> None:
    library = compile_valid(find_library(Path("wiping")))
    state = load_world(find_scene(Path("iiwa_table.ttl")), library.vocabulary, SilentReporter())
    first, second = (decode_snapshot(encode_snapshot(CellSnapshot(library, state, (), number))) for number in (1, 2))
    assert (first.sequence, second.sequence) == (1, 2)
    assert first.library is second.library and first.library == library


def test_the_python_client_has_library_robots_and_version(server: RunningServer) -> None:
    with skillc.connect(f"http://127.0.0.1:{server.port}", server.token) as connected:
        assert connected.version().skillc == version("skillc")
        cell = connected.cell()
        assert cell.library().hash == cell.status.library_hash and cell.robots() == ()


def test_devices_have_what_their_data_sheets_state() -> None:
    library = compile_valid(find_library(Path("wiping")))
    state = load_world(find_scene(Path("iiwa_table.ttl")), library.vocabulary, SilentReporter())
    found = {each.label: each for each in list_devices(state)}
    assert {name: each.kind for name, each in found.items()} == {
        "lab:Robot-1": "robot",
        "lab:Iiwa-1": "arm",
        "lab:Robotiq-1": "gripper",
    }
    arm = found["lab:Iiwa-1"]
    assert arm.part_of == found["lab:Robot-1"].iri and arm.controller == "impedance"
    assert SheetFigure("skillc:contactForceLimit", 80.0, "N") in arm.figures, arm.figures


def test_a_device_is_held_by_the_operation_that_runs(server: RunningServer) -> None:
    server.put_back(pace=0.1)
    operation = server.submit(task="carry_all")["id"]
    assert server.wait_for(operation, "running")["devices"] is None, "a call that names no robot needs the whole cell"
    server.client.post(f"/operations/{operation}/stop", json={})
    assert server.wait_for(operation, "stopped")["devices"] == []


def test_implementations_add_conditions() -> None:
    described = describe_library(compile_valid(find_library(Path("wiping"))))
    added = {each.name: each.pre for skill in described.skills for each in skill.implementations if each.pre}
    assert added, "some implementations need more than their skill"


def test_a_skill_has_the_duration_that_it_declares() -> None:
    library = compile_valid(find_library(Path("wiping")))
    durations = {each.name: each.duration_s for each in describe_library(library).skills}
    declared = {name for name, skill in library.skills.items() if skill.duration is not None}
    assert declared and {name for name, found in durations.items() if found is not None} <= declared
    assert all(found > 0.0 for found in durations.values() if found is not None) and any(durations.values())
