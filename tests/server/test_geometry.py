"""What a cell looks like, over the API: its model, where things are believed, and where tools have worked."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from server.running import RunningServer
from server.test_leases import client_of

PART, TABLE = "http://example.org/lab#Part-A", "http://example.org/lab#Table"


def test_who_may_only_look_gets_the_model_and_the_poses(bench: RunningServer) -> None:
    with client_of(bench, "ann", "view") as ann:
        model, poses = ann.get("/cells/bench/model").json(), ann.get("/cells/bench/poses").json()
        assert ann.get("/cells/bench/coverage").json() == {}, "there is no surface"
    part = model["individuals"][PART]
    assert part["label"] == "lab:Part-A" and model["bodies"][part["body"]]["individual"] == PART
    assert np.allclose(model["bodies"][part["body"]]["pose"], poses[PART])
    placed = {iri for iri, each in model["individuals"].items() if each["kind"] != "gripper"}
    assert placed <= set(poses), "the world knows where everything is"
    assert np.allclose([np.linalg.norm(each[3:]) for each in poses.values()], 1.0)


def test_believed_poses_are_those_of_the_facts_also_where_they_are_wrong(bench: RunningServer) -> None:
    before = bench.client.get("/cells/bench/poses").json()[PART]
    move = {"type": "move", "thing": "lab:Part-A", "by_m": [0.1, 0.0, 0.0]}
    assert bench.client.post("/cells/bench/disturbances", json=move).status_code == 200
    assert bench.client.get("/cells/bench/poses").json()[PART] == before, "nobody has seen it"
    edits = ["lab:Part-A skillc:atX 0.05"]
    seen = bench.client.post("/cells/bench/world/edits", json={"edits": edits, "why": "somebody moved it"})
    assert seen.status_code == 204, seen.text
    assert np.allclose(bench.client.get("/cells/bench/poses").json()[PART][0], before[0] + 0.1)


def test_where_somebody_says_that_a_thing_is(bench: RunningServer) -> None:
    before = bench.client.get("/cells/bench/poses").json()
    x, y, z, *turn = before[PART]
    placed = {"thing": "lab:Part-A", "pose": [x - 0.05, y, z, *turn], "why": "I have seen it there"}
    with client_of(bench, "bob", "operate") as bob:
        assert bob.post("/cells/bench/world/placements", json=placed).status_code == 403
    answer = bench.client.post("/cells/bench/world/placements", json=placed)
    assert answer.status_code == 204, answer.text
    after = bench.client.get("/cells/bench/poses").json()
    assert np.allclose(after[PART], placed["pose"]) and after.keys() == before.keys()
    assert np.allclose(after[TABLE], before[TABLE])
    written = bench.client.get("/cells/bench/world/history", params={"limit": 1}).json()[0]
    assert written["origin"].endswith(": I have seen it there")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"thing": "lab:Nobody"}, "Nobody"),
        ({"pose": [0.0] * 7}, "a quaternion (w, x, y, z) whose length is not 0"),
        ({"pose": [0.0] * 6}, "pose"),
        ({"why": ""}, "why"),
    ],
)
def test_a_placement_that_says_nothing_is_refused(bench: RunningServer, change: dict[str, Any], said: str) -> None:
    before = bench.client.get("/cells/bench/poses").json()
    placed = {"thing": "lab:Part-A", "pose": [0.3, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0], "why": "seen", **change}
    answer = bench.client.post("/cells/bench/world/placements", json=placed)
    assert 400 <= answer.status_code < 500 and said in answer.text
    assert bench.client.get("/cells/bench/poses").json() == before


def test_a_cell_that_does_not_exist_has_no_model(bench: RunningServer) -> None:
    assert bench.client.get("/cells/garden/model").status_code == 404


def test_a_cell_without_shapes_has_an_empty_model(bench: RunningServer) -> None:
    model = bench.client.get("/cells/yard/model").json()
    assert model["individuals"] == {} and [each["name"] for each in model["bodies"]] == ["world"]
    assert bench.client.get("/cells/yard/poses").json() == {}
