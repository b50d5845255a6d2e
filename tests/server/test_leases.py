"""While a client has the lease of a cell only that client commands it; everybody may stop it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta

import httpx
import pytest

from server.running import RunningServer
from skillc.server.access.leases import LeaseHeld, Leases


def test_a_lease_ends_with_its_time_and_not_with_a_clock_on_the_wall() -> None:
    now = [100.0]
    leases = Leases(lambda: now[0])
    leases.take("yard", "ada", 10.0, takeover=False)
    with pytest.raises(LeaseHeld, match="`ada` has the lease of yard for 10 s yet"):
        leases.check("yard", "eve")
    now[0] += 5.0
    assert leases.take("yard", "ada", 10.0, takeover=False).remaining_s == 10.0
    assert leases.take("yard", "eve", 10.0, takeover=True).owner == "eve"
    with pytest.raises(LeaseHeld):
        leases.release("yard", "ada")
    now[0] += 10.0
    leases.check("yard", "ada")
    assert leases.find("yard").owner is None


def test_only_who_has_the_lease_commands_and_everybody_stops(server: RunningServer) -> None:
    with client_of(server, "ada", "operate") as ada, client_of(server, "eve", "operate") as eve:
        assert ada.put("/cells/yard/lease", json={"duration_s": 600}).json()["owner"] == "ada"
        refused = eve.post("/cells/yard/operations", json={"task": "carry_all"})
        assert refused.status_code == 409 and "`ada` has the lease of yard" in refused.json()["detail"]
        assert eve.put("/cells/yard/pace", json={"factor": 1.0}).status_code == 409
        assert eve.delete("/cells/yard/lease").status_code == 409
        assert eve.put("/cells/yard/lease", json={"takeover": True}).status_code == 403
        operation = ada.post("/cells/yard/operations", json={"task": "carry_all", "approve": True}).json()["id"]
        assert eve.post(f"/operations/{operation}/commands", json={"type": "approve"}).status_code == 409
        assert eve.post(f"/operations/{operation}/stop", json={}).status_code == 200
        server.wait_for(operation, "stopped")
        assert server.client.put("/cells/yard/lease", json={"takeover": True}).json()["owner"] == "admin"
        assert ada.put("/cells/yard/pace", json={"factor": 1.0}).status_code == 409
        assert server.client.delete("/cells/yard/lease").status_code == 204
        assert eve.get("/cells/yard/lease").json() == {"cell": "yard", "owner": None, "remaining_s": 0.0}


def test_the_audit_log_has_who_changed_what_and_what_was_refused(server: RunningServer) -> None:
    entries = server.client.get("/audit", params={"limit": 10_000}).json()
    after = entries[-1]["number"] if entries else 0
    with client_of(server, "mallory", "view") as mallory:
        assert mallory.post("/cells/yard/operations", json={"task": "carry_all"}).status_code == 403
    found = server.client.get("/audit", params={"after": after}).json()
    assert [(each["who"], each["action"], each["status"]) for each in found] == [
        ("admin", 'POST /api/v1/tokens {"name":"mallory","role":"view"}', 201),
        ("mallory", "POST /api/v1/cells/yard/operations", 403),
        ("admin", "DELETE /api/v1/tokens/mallory", 204),
    ]
    assert "needs the role `operate`" in found[1]["detail"] and found[1]["origin"] == "127.0.0.1"


@contextmanager
def client_of(server: RunningServer, name: str, role: str) -> Iterator[httpx.Client]:
    """Return a client with a token of its own, which is revoked at the end."""
    token = server.client.post("/tokens", json={"name": name, "role": role}).json()["token"]
    try:
        with server.client_of(token) as client:
            yield client
    finally:
        server.client.delete(f"/tokens/{name}")


def test_the_events_of_an_operation_have_who_gave_each_command(server: RunningServer) -> None:
    server.put_back()
    operation = server.submit(task="carry_all", approve=True)["id"]
    server.wait_for(operation, "planned")
    answer = server.client.post(f"/operations/{operation}/commands", json={"type": "approve", "who": "somebody else"})
    assert answer.status_code == 200, answer.text
    server.client.post(f"/operations/{operation}/stop", json={})
    events = [each["event"] for each in server.client.get(f"/operations/{operation}/events").json()]
    requested = [each["command"] for each in events if each["type"] == "requested"]
    assert requested[0] == {"type": "approve", "who": "admin"}, "who has the token, whatever the request says"


def test_an_agent_cannot_approve_its_own_operation(server: RunningServer) -> None:
    server.put_back()
    wanted = {"name": "agent-1", "agent": True}
    refused = server.client.post("/tokens", json={**wanted, "role": "admin"})
    assert refused.status_code == 409 and "could make other tokens" in refused.json()["detail"]
    made = server.client.post("/tokens", json={**wanted, "role": "operate"}).json()
    with server.client_of(made["token"]) as agent:
        submitted = agent.post("/cells/yard/operations", json={"task": "carry_all", "approve": False})
        operation = submitted.json()["id"]
        assert submitted.status_code == 201 and submitted.json()["request"]["approve"] is True
        server.wait_for(operation, "planned")
        command = {"type": "approve"}
        refused = agent.post(f"/operations/{operation}/commands", json=command)
        assert refused.status_code == 403 and "cannot approve its own operation" in refused.json()["detail"]
        others = server.submit(goal="lab:Goal contain lab:crate-0", approve=True)["id"]
        assert server.client.post(f"/operations/{operation}/commands", json=command).status_code == 200
        server.wait_for(operation, "succeeded")
        server.wait_for(others, "planned")
        assert agent.post(f"/operations/{others}/commands", json=command).status_code == 200
        server.client.post(f"/operations/{others}/stop")
        at = (datetime.now(UTC) + timedelta(days=1)).isoformat()
        ordered = agent.post("/cells/yard/orders", json={"request": {"task": "carry_all"}, "at": at}).json()
        assert ordered["order"]["request"]["approve"] is True
        assert agent.delete(f"/orders/{ordered['id']}").status_code == 204
    listed = server.client.get("/tokens").json()
    assert [each["name"] for each in listed if each["agent"]] == ["agent-1"]
    server.client.delete("/tokens/agent-1")
