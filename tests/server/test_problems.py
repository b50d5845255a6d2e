"""Refusals are problem details (RFC 9457): their kinds, and the errors of what was requested, as clients show them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import skillc
from server.running import RunningServer
from server.test_client_commands import here, type_in  # noqa: F401
from skillc.server.problems import DIAGNOSTICS, KEY_REUSED, LEASE_HELD, NOT_ALLOWED

GOAL = "lab:Goal contain lab:crate-9"
PLACE = {"path": "goal", "line": 1, "column": 18, "end_line": 1, "end_column": 29}
WAYS = (
    ("cells/yard/operations", {"goal": GOAL}, 409),
    ("jobs", {"kind": "rehearsal", "goal": GOAL}, 422),
    ("cells/yard/orders", {"request": {"goal": GOAL}, "at": "2100-01-01T00:00:00Z"}, 422),
)


@pytest.mark.parametrize(("path", "body", "status"), WAYS, ids=[path for path, *_ in WAYS])
def test_the_errors_of_a_goal_are_data(server: RunningServer, path: str, body: dict[str, Any], status: int) -> None:
    problem = server.client.post(f"/{path}", json=body).json()
    assert (problem["status"], problem["type"], problem["title"]) == (status, DIAGNOSTICS.type, DIAGNOSTICS.title)
    (found,) = problem["diagnostics"]
    assert (found["name"], found["severity"]) == ("unknown-individual", "error")
    assert {name: found[name] for name in PLACE} == PLACE
    assert "did you mean" in found["help"] and problem["texts"] == {"goal": GOAL}
    assert problem["detail"] == f"goal:1:18: {found['message']} ({found['help']})"


def test_the_errors_of_an_argument_are_data(server: RunningServer) -> None:
    arguments = {"crate": "lab:Goal", "to": "lab:Goal"}
    answer = server.client.post("/cells/yard/operations", json={"task": "carry", "arguments": arguments})
    (found,) = answer.json()["diagnostics"]
    assert found["path"] == "call" and answer.json()["texts"] == {"call": "carry(crate: lab:Goal, to: lab:Goal)"}


def test_a_long_text_is_not_sent_back(server: RunningServer) -> None:
    goal = " and ".join([GOAL] * 1000)
    problem = server.client.post("/cells/yard/operations", json={"goal": goal}).json()
    assert 0 < len(problem["diagnostics"]) <= 20 and "texts" not in problem


def test_kinds_of_problems_are_known_by_their_type(server: RunningServer) -> None:
    server.put_back()
    name = server.submit(goal="lab:Goal contain lab:crate-1", approve=True)["id"]
    server.wait_for(name, "planned")
    refused = server.client.post(f"/operations/{name}/commands", json={"type": "retry"}).json()
    assert (refused["type"], refused["title"]) == (NOT_ALLOWED.type, NOT_ALLOWED.title) and refused["allowed"]
    server.client.post(f"/operations/{name}/stop", json={})
    key = {"Idempotency-Key": "of the first"}
    server.client.post("/cells/yard/operations", json={"goal": "lab:Goal contain lab:crate-1"}, headers=key)
    reused = server.client.post("/cells/yard/operations", json={"goal": GOAL}, headers=key).json()
    assert reused["type"] == KEY_REUSED.type
    other = server.client_of(server.client.post("/tokens", json={"name": "ada", "role": "operate"}).json()["token"])
    other.put("/cells/yard/lease", json={})
    held = server.client.post("/cells/yard/operations", json={"goal": GOAL}).json()
    assert held["type"] == LEASE_HELD.type and "diagnostics" not in held
    other.delete("/cells/yard/lease")
    server.client.delete("/tokens/ada")
    unknown = server.client.get("/operations/none").json()
    assert (unknown["type"], unknown["title"]) == ("about:blank", "Not Found")


def test_a_program_has_them_as_diagnostics(server: RunningServer) -> None:
    with skillc.connect(f"http://127.0.0.1:{server.port}", server.token) as connected:
        with pytest.raises(skillc.RefusedError, match="goal:1:18: ") as refused:
            connected.cell().start(goal=GOAL)
        assert (refused.value.status, refused.value.type) == (409, DIAGNOSTICS.type)
        assert [(each.name, each.span.column) for each in refused.value.diagnostics] == [("unknown-individual", 18)]
        with pytest.raises(skillc.RefusedError) as missing:
            connected.operation("none")
        assert (missing.value.type, missing.value.diagnostics) == ("about:blank", ())


@pytest.mark.parametrize("words", [("start",), ("plan", "--cell", "yard"), ("rehearse",)], ids=lambda words: words[0])
def test_the_shell_shows_them_as_without_a_server(here: RunningServer, words: tuple[str, ...]) -> None:  # noqa: F811
    with_server = type_in(*words, "--goal", GOAL)
    yard = Path(here.folder)
    without = type_in("plan", "--goal", GOAL, "--library", str(yard), "--scene", str(yard / "yard.ttl"))
    assert with_server.exit_code == 1 and with_server.stderr == without.stderr
    assert "error[unknown-individual]: " in with_server.stderr and f"1 | {GOAL}" in with_server.stderr


def test_check_as_json_has_the_same_form(here: RunningServer, tmp_path: Path) -> None:  # noqa: F811
    (tmp_path / "wrong.skill").write_text("library wrong\n\ntask t {\n    do { Nothing() }\n}\n")
    (checked, *_) = json.loads(type_in("check", str(tmp_path), "--json").stdout)
    (found,) = here.client.post("/cells/yard/operations", json={"goal": GOAL}).json()["diagnostics"]
    assert found.keys() == checked.keys()


def test_a_reason_has_words(server: RunningServer) -> None:
    before = server.client.get("/cells/yard/world/history").json()
    refused = server.client.post("/cells/yard/world/edits", json={"edits": ["not lab:crate-1"], "why": " \t"})
    assert (refused.status_code, refused.json()["detail"]) == (422, "say why: the reason is blank")
    assert server.client.get("/cells/yard/world/history").json() == before
