"""An emergency stop of a cell over the API: who may acknowledge it, and when."""

from __future__ import annotations

import json

import pytest

import skillc
from server.running import RunningServer
from server.test_leases import client_of
from skillc.devices import PressEmergencyStop, PushArm

PATH = "/cells/yard"


def test_after_an_emergency_stop_nothing_runs_until_it_is_acknowledged(server: RunningServer) -> None:
    server.put_back(pace=0.1)
    running, waiting = server.submit(task="carry_all")["id"], server.submit(task="carry_all", approve=True)["id"]
    server.wait_for(running, "running")
    pressed = server.client.post(f"{PATH}/disturbances", json={"type": "emergency-stop", "pressed": True})
    assert pressed.status_code == 200 and pressed.json()["state"] == "emergency-stop"
    for operation in (running, waiting):
        ended = server.wait_for(operation, "failed")
        assert ended["reason"] == "emergency stop: an emergency stop is pressed"
    refused = server.client.post(f"{PATH}/operations", json={"task": "carry_all"})
    assert refused.status_code == 409 and "(emergency-stop): an emergency stop is pressed" in refused.json()["detail"]
    assert 'skillc_cell_state{cell="yard",state="emergency-stop"} 1.0' in server.client.get("/metrics").text
    with client_of(server, "eve", "view") as eve, client_of(server, "ada", "operate") as ada:
        assert eve.post(f"{PATH}/acknowledge").status_code == 403
        assert eve.post(f"{PATH}/disturbances", json={"type": "emergency-stop"}).status_code == 403
        assert "still pressed" in ada.post(f"{PATH}/acknowledge").json()["detail"]
        released = ada.post(f"{PATH}/disturbances", json={"type": "emergency-stop", "pressed": False})
        assert released.json()["state"] == "emergency-stop", "nothing goes on by itself"
        server.client.put(f"{PATH}/lease", json={})
        assert "has the lease" in ada.post(f"{PATH}/acknowledge").json()["detail"]
        server.client.delete(f"{PATH}/lease")
        assert ada.post(f"{PATH}/acknowledge").json()["state"] == "operational"
    entries = server.client.get("/audit", params={"limit": 10_000}).json()
    wanted = [each["status"] for each in entries if each["who"] == "ada" and each["action"].endswith("/acknowledge")]
    assert wanted == [409, 409, 200]
    server.client.put(f"{PATH}/pace", json={"factor": None})
    server.wait_for(server.submit(goal="lab:Goal contain lab:crate-0")["id"], "succeeded")


@pytest.mark.parametrize(
    ("body", "status", "said"),
    [
        ({"type": "push", "arm": "lab:Arm-1", "force_n": [1, 0, 0]}, 409, "no individual lab:Arm-1"),
        ({"type": "push", "arm": "lab:Cart-1", "force_n": [1, 0, 0]}, 409, "is no arm with a hand"),
        ({"type": "push", "arm": "lab:Cart-1", "force_n": [1e9, 0, 0]}, 422, "<= 1000.0"),
        ({"type": "move", "thing": "lab:Goal", "by_m": [0.1, 0, 0]}, 409, "is nothing that can be moved"),
        ({"type": "move", "thing": "lab:Goal", "by_m": [0.1, 0]}, 422, "length 3"),
        ({"type": "earthquake"}, 422, "earthquake"),
    ],
)
def test_a_disturbance_that_is_not_possible_changes_nothing(
    server: RunningServer, body: dict[str, object], status: int, said: str
) -> None:
    answer = server.client.post(f"{PATH}/disturbances", json=body)
    assert answer.status_code == status and said in answer.json()["detail"]
    assert server.client.get(PATH).json()["state"] == "operational"


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (b"", None),
        (b"", "text/plain"),
        (b'{"why": "it is hot"}', "application/json"),
        (json.dumps({"reason": "x" * 100_000}).encode(), "application/json"),
    ],
)
@pytest.mark.parametrize("path", ["/cells/yard/stop", "/operations/{operation}/stop"])
def test_no_form_of_a_stop_is_a_reason_not_to_stop(
    server: RunningServer, path: str, content: bytes, kind: str | None
) -> None:
    operation = server.submit(task="carry_all", approve=True)["id"]
    server.wait_for(operation, "planned")
    headers = {} if kind is None else {"Content-Type": kind}
    assert server.client.post(path.format(operation=operation), content=content, headers=headers).status_code == 200
    assert len(server.wait_for(operation, "stopped")["reason"]) < 600


def test_a_stop_that_cannot_be_read_says_that_nothing_was_done(server: RunningServer) -> None:
    refused = server.client.post("/cells/yard/stop", content=b"reason=hot", headers={"Content-Type": "text/plain"})
    assert refused.status_code == 415 and "nothing was done" in refused.json()["detail"]


def test_a_cell_is_disturbed_from_python(server: RunningServer) -> None:
    with skillc.connect(f"http://127.0.0.1:{server.port}", state=server.folder / "served") as connected:
        cell = connected.cell()
        assert cell.disturb(PressEmergencyStop()).state == "emergency-stop"
        assert cell.disturb(PressEmergencyStop(False)).reason == "an emergency stop is pressed"
        assert cell.acknowledge().state == "operational"
        with pytest.raises(skillc.RefusedError, match="is no arm with a hand"):
            cell.disturb(PushArm("lab:Cart-1", (1.0, 0.0, 0.0)))
