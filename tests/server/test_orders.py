"""Orders are submitted at their time once, whatever the clock, the server and its cell do meanwhile."""

from __future__ import annotations

import asyncio
import json
import re
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from pathlib import Path
from random import Random
from typing import Any, cast

import pytest

import skillc
from server.running import RunningServer, wait_until
from server.test_client_commands import here, type_in  # noqa: F401  a fixture
from skillc.cells.database import Schema, open_for_writing
from skillc.cells.settings import CellSettings
from skillc.contract.messages import Message, Refused, Submit
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.contract.order import Missed, Order, OrderRequest
from skillc.server.context import ServerContext
from skillc.server.hub import EventHub
from skillc.server.orders.submitting import submit_due
from skillc.server.state import DATABASE, SCHEMA, open_state
from skillc.server.supervisor import CellSupervisor

NOON = datetime(2030, 1, 1, 12, tzinfo=UTC)
CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}}


class ListingCell(CellSupervisor):
    """A cell without a process that takes operations while it is `on`, and lists them."""

    def __init__(self, folder: Path) -> None:
        super().__init__(CellSettings(name="yard", scene="", library="", folder=str(folder)), lambda _: None)
        self.on, self.refusal = True, cast("Refused | None", None)
        self.taken: list[str] = []

    @property
    def ready(self) -> bool:
        """Whether it takes operations."""
        return self.on

    async def request(self, message: Message) -> Refused | bytes:
        """List what is submitted."""
        assert isinstance(message, Submit)
        if self.refusal is not None:
            return self.refusal
        self.taken.append(message.operation)
        return b""


@dataclass
class Desk:
    """A server's orders and their clock."""

    server: ServerContext
    cell: ListingCell
    owner: str = "ada"
    names: list[str] = field(default_factory=list)

    def order(self, every_s: float | None = None, missed: Missed = "run-once", **settings: Any) -> str:
        name = f"order-{len(self.names)}"
        self.names.append(name)
        request = OrderRequest(OperationRequest(task="carry_all"), NOON, every_s, missed=missed, **settings)
        self.server.orders.add(name, "yard", self.owner, request)
        return name

    def look(self, *seconds: float) -> list[str]:
        """Let the clock show these times after noon, one after the other; return what was submitted."""
        before = len(self.cell.taken)
        for each in seconds:
            asyncio.run(submit_due(self.server, self.cell, NOON + timedelta(seconds=each)))
        return [each.removeprefix("order-") for each in self.cell.taken[before:]]

    def show(self, name: str = "order-0") -> Order:
        found = self.server.orders.find(name)
        assert found is not None
        return found


@pytest.fixture
def desk(tmp_path: Path) -> Iterator[Desk]:
    cell = ListingCell(tmp_path)
    with open_state(tmp_path / "state") as state:
        state.tokens.add("ada", "operate")
        yield Desk(ServerContext(state, {"yard": cell}, EventHub()), cell)


def test_an_order_is_submitted_once_and_ends(desk: Desk) -> None:
    name = desk.order()
    assert desk.look(-1.0, -0.1) == [] and desk.look(0.2, 0.7, 100.0) == ["0-1"]
    assert desk.show(name).next_at is None and desk.show(name).operation == "order-0-1"


def test_a_clock_that_jumps_repeats_nothing(desk: Desk) -> None:
    desk.order(every_s=10.0)
    assert desk.look(0.0, 5.0, 10.5) == ["0-1", "0-2"]
    assert desk.look(10_000.0, 10_000.5) == ["0-1001"], "one after a jump forward"
    assert desk.look(0.0, 10.0, 9_999.0) == [], "none after a jump back"
    assert desk.look(10_010.0) == ["0-1002"]
    assert desk.show().next_at == NOON + timedelta(seconds=10_020.0)


def test_a_clock_that_jumps_at_random_submits_nothing_twice(desk: Desk) -> None:
    chance = Random(0)
    for number in range(5):
        desk.order(
            every_s=chance.uniform(1.0, 100.0), missed=chance.choice(("run-once", "skip")), count=1 + 40 * number
        )
    desk.look(*(chance.uniform(-1000.0, 5000.0) for _ in range(100)))
    assert len(desk.cell.taken) >= 10 and len(set(desk.cell.taken)) == len(desk.cell.taken)


def test_orders_end_by_count_and_by_time(desk: Desk) -> None:
    desk.order(every_s=10.0, count=2)
    desk.order(every_s=10.0, until=NOON + timedelta(seconds=20.0))
    assert desk.look(0.0, 10.0, 20.0, 30.0) == ["0-1", "1-1", "0-2", "1-2", "1-3"]
    assert [each.next_at for each in desk.server.orders.list("yard")] == [None, None]
    assert desk.server.orders.list_open("yard") == ()


def test_what_was_missed_is_submitted_once_or_skipped(desk: Desk) -> None:
    desk.order(every_s=100.0)
    desk.order(every_s=100.0, missed="skip")
    desk.cell.on = False
    assert desk.look(0.0, 30.0, 130.0) == [] and "yard is off" in desk.show().reason
    desk.cell.on = True
    assert desk.look(190.0) == ["0-2"] and desk.show("order-1").reason.startswith("missed: yard is off")
    assert desk.look(200.0) == ["0-3", "1-3"] and desk.show("order-1").reason == ""


def test_an_operation_waits_for_the_one_before_and_for_the_lease(desk: Desk) -> None:
    desk.order(every_s=10.0)
    assert desk.look(0.0) == ["0-1"]
    running = OperationStatus(id="order-0-1", cell="yard", request=OperationRequest(), state="running")
    desk.cell.operations["order-0-1"] = running
    assert desk.look(10.0, 20.0, 30.0) == [] and desk.show().reason == "order-0-1 has not ended"
    desk.cell.operations.clear()
    desk.server.leases.take("yard", "eve", 60.0, takeover=False)
    assert desk.look(35.0) == [] and "`eve` has the lease" in desk.show().reason
    desk.server.leases.release("yard", "eve")
    assert desk.look(36.0) == ["0-4"]


def test_the_owner_of_a_revoked_token_submits_nothing(desk: Desk) -> None:
    desk.order(every_s=10.0)
    desk.server.state.tokens.revoke("ada")
    assert desk.look(0.0) == [] and desk.show().reason == "the token `ada` is revoked"
    desk.server.state.tokens.add("ada", "view")
    assert desk.look(10.0) == [] and "`ada` has the role `view`" in desk.show().reason
    refused = [each for each in desk.server.audit.entries(0, 10) if each.action == "order order-0"]
    assert [each.status for each in refused] == [409, 409]


def test_what_the_cell_refuses_is_noted_and_what_it_cannot_take_now_waits(desk: Desk) -> None:
    desk.order(every_s=10.0)
    desk.cell.refusal = Refused(kind="busy", reason="too many")
    assert desk.look(0.0) == [] and desk.show().next_at == NOON
    desk.cell.refusal = Refused(kind="invalid", reason="there is no task")
    assert desk.look(1.0) == [] and desk.show().reason == "there is no task"
    assert desk.show().next_at == NOON + timedelta(seconds=10.0)


def test_orders_that_ended_are_forgotten_in_time(desk: Desk) -> None:
    for _ in range(110):
        desk.order()
    desk.look(0.0)
    assert len(desk.server.orders.list("yard")) == 100


def test_a_state_without_orders_gets_them(tmp_path: Path) -> None:
    later = ("TABLE orders", "TABLE jobs", "TABLE job_events", "TABLE sessions")
    tables = re.sub(r",\s*agent +INTEGER[^\n]*", "", SCHEMA.tables).split(";\n")
    older = Schema(1, ";\n".join(each for each in tables if not any(map(each.__contains__, later))))
    open_for_writing(tmp_path / DATABASE, older).close()
    with open_state(tmp_path) as state:
        state.database.execute("SELECT * FROM orders")
    with closing(sqlite3.connect(tmp_path / f"{DATABASE}.format-1")) as kept, pytest.raises(sqlite3.OperationalError):
        kept.execute("SELECT * FROM orders")


def add(server: RunningServer, after_s: float, key: str | None = None, **order: Any) -> Any:
    at = (datetime.now(UTC) + timedelta(seconds=after_s)).isoformat()
    headers = {} if key is None else {"Idempotency-Key": key}
    body = {"request": CARRY, "at": at, **order}
    return server.client.post("/cells/yard/orders", json=body, headers=headers)


def find_submitted(server: RunningServer, order: str) -> list[str]:
    listed = server.client.get("/cells/yard/operations").json()
    return [each["id"] for each in listed if each["id"].startswith(order)]


def test_a_server_carries_orders_out(server: RunningServer) -> None:
    server.put_back()
    answer = add(server, 0.0)
    assert answer.status_code == 201, answer.text
    name = answer.json()["id"]
    wait_until(lambda: find_submitted(server, name), bool)
    done = server.wait_for(f"{name}-1", "succeeded")
    assert done["request"]["owner"] == "admin"
    listed = {each["id"]: each for each in server.client.get("/cells/yard/orders").json()}
    assert listed[name]["operation"] == f"{name}-1" and listed[name]["next_at"] is None
    assert server.client.delete(f"/orders/{name}").status_code == 204
    assert server.client.delete(f"/orders/{name}").status_code == 404


def test_the_same_request_twice_is_one_order(server: RunningServer) -> None:
    at = (datetime.now(UTC) + timedelta(hours=1)).isoformat()
    first, second = (add(server, 0.0, "orders-1", at=at) for _ in range(2))
    assert (first.status_code, second.status_code) == (201, 201) and first.json() == second.json()
    assert add(server, 3600.0, "orders-1").status_code == 422
    assert server.client.delete(f"/orders/{first.json()['id']}").status_code == 204


@pytest.mark.parametrize(
    ("order", "detail"),
    [
        ({"at": "2001-01-01T00:00:00Z"}, "is past"),
        ({"at": "9999-12-31T23:59:59-12:00"}, "is past, or after 2200"),
        ({"at": "2100-01-01T00:00:00"}, "timezone"),
        ({"count": 2}, "need `every_s`"),
        ({"every_s": 0.1}, ">= 1"),
        ({"every_s": 10, "until": "2001-01-01T00:00:00Z"}, "`until` is before `at`"),
        ({"request": {}}, "exactly one"),
        ({"request": {"continues": "one"}}, "cannot continue"),
        ({"request": {"task": "carry_al"}}, "did you mean `carry_all`"),
        ({"request": {"task": "carry", "arguments": {"crate": "lab:crate-1"}}}, "to"),
        ({"request": {"goal": "lab:Goal contains lab:crate-1"}}, "contains"),
    ],
)
def test_what_is_no_order_is_refused(server: RunningServer, order: dict[str, Any], detail: str) -> None:
    before = server.client.get("/cells/yard/orders").json()
    refused = add(server, 10.0, "refused", **order)
    assert refused.status_code == 422 and detail in refused.json()["detail"]
    assert server.client.get("/cells/yard/orders").json() == before


def test_programs_and_the_shell_order(here: RunningServer) -> None:  # noqa: F811
    at = datetime.now(UTC) + timedelta(hours=1)
    with skillc.connect(f"http://127.0.0.1:{here.port}", state=here.folder / "served") as connected:
        cell = connected.cell()
        made = cell.order("carry_all", at=at, every_s=60.0, count=3)
        assert made in cell.orders() and made.next_at == at
        cell.remove_order(made.id)
        assert made not in cell.orders()
        with pytest.raises(skillc.RequestError, match="offset from UTC"):
            cell.order("carry_all", at=datetime(2100, 1, 1))
    ordered = type_in("start", "carry_all", "--at", "2100-01-01T08:00:00Z", "--every", "3600", "--count", "2")
    assert ordered.exit_code == 0, ordered.stderr
    name = ordered.stdout.strip()
    shown = type_in("orders")
    assert name in shown.stdout and "2100-01-01 08:00:00Z" in shown.stdout
    assert [each["id"] for each in json.loads(type_in("orders", "--json").stdout)] == [name]
    assert type_in("orders", "--remove", name).exit_code == 0
    assert name not in type_in("orders").stdout
    for wrong in (("--every", "3600"), ("--at", "8 o'clock"), ("--at", "2100-01-01T08:00:00Z", "--wait")):
        assert type_in("start", "carry_all", *wrong).exit_code == 2
