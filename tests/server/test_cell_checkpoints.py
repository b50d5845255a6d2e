"""A simulated cell is reset, saved and restored by clients, who are named in the history of its world."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import skillc
from server.running import RunningServer, serving
from server.test_client_commands import here, type_in  # noqa: F401  a fixture
from server.test_leases import client_of

ALL = "forall c: Product (lab:Goal contain c)"


def steps(server: RunningServer, name: str) -> int:
    """Return how many calls an operation that succeeded has made."""
    server.wait_for(name, "succeeded")
    events = server.client.get(f"/operations/{name}/events").json()
    return sum(each["event"]["type"] == "implementation-chosen" for each in events)


def carry(server: RunningServer) -> int:
    return steps(server, server.submit(goal=ALL)["id"])


def contained(server: RunningServer) -> dict[str, tuple[Any, Any]]:
    """Return where each crate is, and how that is known."""
    facts = server.client.get("/cells/yard/world", params={"limit": 1000}).json()["facts"]
    return {
        each["fact"]["object"]["label"]: (each["fact"]["subject"]["label"], each.get("evidence"))
        for each in facts
        if each["fact"].get("relation", {}).get("label") == "contain"
    }


def test_a_cell_is_reset_saved_and_restored(server: RunningServer) -> None:
    client = server.client
    client.put("/cells/yard/pace", json={"factor": None})
    before = client.get("/cells/yard").json()
    assert before["resettable"] is True
    assert client.post("/cells/yard/reset").json()["resets"] == before["resets"] + 1
    assert set(contained(server).values()) == {("lab:Start", None)}
    assert carry(server) == 12
    assert carry(server) == 0, "the goal holds already"
    done = contained(server)
    assert set(done.values()) == {("lab:Goal", "assumed")}
    with client_of(server, "bo", "operate") as bo:
        made = bo.post("/cells/yard/checkpoints", json={"name": "all-there"})
        assert (made.status_code, made.json()["who"]) == (201, "bo")
        assert bo.post("/cells/yard/reset", json={"why": "a demonstration"}).status_code == 200
    assert carry(server) == 12
    client.post("/cells/yard/reset")
    assert client.post("/cells/yard/checkpoints/all-there/restore").status_code == 200
    assert contained(server) == done, "also how it is known"
    origins = [each["origin"] for each in client.get("/cells/yard/world/history", params={"limit": 500}).json()]
    assert "bo: reset to the scene, a demonstration" in origins and origins[0] == "admin: restored all-there"
    assert [each["name"] for each in client.get("/cells/yard/checkpoints").json()] == ["all-there"]
    assert client.delete("/cells/yard/checkpoints/all-there").status_code == 204
    assert client.get("/cells/yard/checkpoints").json() == []
    client.post("/cells/yard/reset")


def test_what_cannot_be_is_refused_with_a_sentence(server: RunningServer) -> None:
    def refuse(path: str, status: int, said: str, **body: Any) -> None:
        answer = server.client.post(f"/cells/yard{path}", json=body)
        assert (answer.status_code, said in answer.text) == (status, True), answer.text

    refuse("/checkpoints/none/restore", 404, "yard has no checkpoint none; there are: none")
    refuse("/checkpoints", 422, "name", name="../up")
    refuse("/reset", 422, "wherefore", wherefore="x")
    name = server.submit(goal=ALL, approve=True)["id"]
    try:
        refuse("/reset", 409, f"{name} goes on or waits in yard; stop it, or wait until it has ended")
        refuse("/checkpoints", 409, "goes on or waits", name="now")
    finally:
        server.client.post("/cells/yard/stop")
    server.wait_for(name, "stopped")
    with client_of(server, "cy", "view") as cy:
        assert cy.post("/cells/yard/reset").status_code == 403
        assert cy.get("/cells/yard/checkpoints").status_code == 200
    with client_of(server, "di", "operate") as di:
        assert di.put("/cells/yard/lease", json={}).status_code == 200
        refuse("/reset", 409, "`di` has the lease")
        di.delete("/cells/yard/lease")


def test_a_cell_is_reset_saved_and_restored_on_the_command_line(here: RunningServer) -> None:  # noqa: F811
    reset = type_in("cell", "reset", "--why", "once more")
    assert (reset.exit_code, reset.stdout) == (0, "")
    assert reset.stderr.startswith("yard: reset to ") and reset.stderr.endswith("yard.ttl\n")
    assert type_in("cell", "save", "fresh").stderr == "yard: saved as fresh\n"
    again = type_in("cell", "save", "fresh")
    assert again.exit_code == 1 and "there is a checkpoint fresh already; remove it first" in again.stderr
    assert [each["name"] for each in json.loads(type_in("cell", "list", "--json").stdout)] == ["fresh"]
    assert "fresh  20" in type_in("cell", "list").stdout
    assert type_in("cell", "restore", "fresh").stderr == "yard: restored from fresh\n"
    assert type_in("cell", "remove", "fresh").stderr == "fresh: removed\n"
    wrong = type_in("cell", "restore", "fresh")
    assert wrong.exit_code == 1 and "yard has no checkpoint fresh; there are: none" in wrong.stderr
    assert "admin: reset to the scene, once more" in type_in("world", "--cell", "yard", "--history").stdout


@pytest.mark.slow
def test_what_was_saved_survives_a_restart_of_the_server(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        server.client.put("/cells/yard/pace", json={"factor": None})
        assert carry(server) == 12
        done = contained(server)
        cell = skillc.connect(f"http://127.0.0.1:{server.port}", state=server.folder / "served").cell()
        assert cell.save("all").who == "admin"
        assert cell.reset().resets == 1
    with serving(tmp_path) as server:
        assert set(contained(server).values()) == {("lab:Start", None)}
        cell = skillc.connect(f"http://127.0.0.1:{server.port}", state=server.folder / "served").cell()
        assert [each.name for each in cell.checkpoints()] == ["all"]
        cell.restore("all")
        assert contained(server) == done
