"""The Python client does with a server what the API of operations does in the program, and misses no event."""

from __future__ import annotations

import asyncio
import signal
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import skillc
from server.cutting import cutting, cutting_first_change
from server.running import RunningServer, serving, start_server, wait_until
from skillc.client.address import ServerAddress, find_address
from skillc.client.connection import Connection
from skillc.client.feed import follow_operation
from skillc.contract.cell import CellStatus
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded
from waiting import LONG_S

MAX_BYTES = 4_000


@pytest.fixture
def connected(server: RunningServer) -> Iterator[skillc.Server]:
    with skillc.connect(f"http://127.0.0.1:{server.port}", state=server.folder / "served") as found:
        yield found


def test_an_operation_is_commanded_like_one_of_the_program(server: RunningServer, connected: skillc.Server) -> None:
    server.put_back()
    cell = connected.cell()
    cell.set_pace("real")
    assert cell.name == "yard" and cell.status.pace == 1.0
    with pytest.raises(skillc.RequestError, match="no operation goes on"):
        connected.operation()
    operation = cell.start("carry", arguments={"crate": "lab:crate-1", "to": "lab:Goal"}, approve=True, key="one")
    assert operation.wait_for_pause() == "planned" and "approve" in operation.allowed
    assert cell.start("carry", arguments={"crate": "lab:crate-1", "to": "lab:Goal"}, approve=True, key="one").id == (
        connected.operation().id
    )
    cell.set_pace(0.05)
    operation.approve()
    wait_until(lambda: operation.state, lambda state: state == "running")
    operation.pause("look")
    assert (operation.state, operation.reason) == ("paused", "look")
    with pytest.raises(skillc.RefusedError, match=r"`approve` is not possible while the task is paused; it allows"):
        operation.approve()
    cell.set_pace("fast")
    assert operation.step() == "paused"
    with pytest.raises(skillc.RequestError, match=r"carry has not ended within 0.05 s; it is paused"):
        operation.wait(0.05)
    operation.resume()
    ended = operation.wait(LONG_S)
    assert ended.state == "succeeded" and operation.ended and connected.ongoing() == ()
    assert [each.sequence for each in operation.events(after=3)] == list(range(4, ended.events + 1))
    assert [each.id for each in cell.operations(limit=1)] == [operation.id]
    operation.stop()
    assert operation.state == "succeeded"


def test_coroutines_do_the_same_without_blocking(server: RunningServer) -> None:
    async def follow() -> tuple[list[int], str]:
        async with skillc.connect_async(f"http://127.0.0.1:{server.port}", server.token) as found:
            cell = await found.cell("yard")
            await cell.set_pace("fast")
            operation = await cell.start(goal="lab:Start contain lab:crate-1")
            numbers = [each.sequence async for each in operation.events()]
            return numbers, (await operation).state

    numbers, state = asyncio.run(follow())
    assert state == "succeeded" and numbers == list(range(1, len(numbers) + 1))


def test_what_is_refused_says_why(server: RunningServer, connected: skillc.Server) -> None:
    with pytest.raises(skillc.RefusedError, match="there is no task `carry_al`") as refused:
        connected.cell().start("carry_al")
    assert refused.value.status == 409
    with pytest.raises(skillc.RequestError, match="there is no cell `barn`; the server has yard"):
        connected.cell("barn")
    with pytest.raises(skillc.RefusedError, match="there is no operation `none`"):
        connected.operation("none")
    with pytest.raises(skillc.RequestError, match="exactly one of a task, a goal and a skill call"):
        connected.cell().start("carry_all", goal="lab:Goal contain lab:crate-1")
    token = connected.add_token("watcher", "view")
    with skillc.connect(f"http://127.0.0.1:{server.port}", token) as watcher:
        with pytest.raises(skillc.RefusedError, match="needs the role `operate`"):
            watcher.cell().start("carry_all")
        connected.revoke_token("watcher")
        with pytest.raises(skillc.RequestError, match="does not know this token"):
            watcher.cells()
    assert "watcher" not in [each.name for each in connected.tokens()]


def test_addresses_that_would_give_a_token_away_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".skillc").mkdir()
    (tmp_path / ".skillc/admin.token").write_text("secret")
    assert find_address(None, None, None).token == "secret"
    for url in ("http://cells.example.org", "https://cells.example.org", "cells.example.org", "ftp://localhost"):
        with pytest.raises(skillc.RequestError):
            find_address(url, None, None)
    assert find_address("https://cells.example.org/api/v1/", "t", None).url == "https://cells.example.org/api/v1"
    assert "secret" not in repr(find_address("http://[::1]:80", None, None))
    with pytest.raises(skillc.SkillcError, match=r"no server answers at .*127.0.0.1:1; start one with"):
        skillc.connect("http://127.0.0.1:1")
    with monkeypatch.context() as patch, pytest.raises(skillc.SkillcError, match=r"pip install 'skillc\[server\]'"):
        patch.setitem(sys.modules, "httpx", None)
        skillc.connect()
    with pytest.raises(skillc.RequestError, match=r"there is no token for .*: elsewhere.admin.token does not exist"):
        skillc.connect(state="elsewhere")


def test_connections_that_break_lose_and_double_no_event(server: RunningServer, connected: skillc.Server) -> None:
    server.put_back()
    operation = connected.cell().start("carry", arguments={"crate": "lab:crate-2", "to": "lab:Goal"})
    with cutting(server.port, seed=4, max_bytes=MAX_BYTES) as relay:
        address = find_address(f"http://127.0.0.1:{relay.port}", server.token, None)
        found = asyncio.run(read_events(address, operation.id))
        assert relay.cuts >= 1
    assert [each.sequence for each in found] == list(range(1, operation.status.events + 1))
    assert isinstance(found[-1].event, TaskEnded)


def connect_through(server: RunningServer, port: int) -> skillc.Server:
    """Connect to another port of this machine with the token of a server."""
    return skillc.connect(f"http://127.0.0.1:{port}", server.token)


def test_a_stop_whose_connection_is_cut_is_sent_again(server: RunningServer, connected: skillc.Server) -> None:
    server.put_back()
    operation = connected.cell().start("carry_all", approve=True)
    operation.wait_for_pause()
    with cutting_first_change(server.port) as relay, connect_through(server, relay.port) as through:
        with pytest.raises(skillc.UnavailableError):
            through.cell("yard").set_pace("fast")
        assert relay.cuts == 1
    with cutting_first_change(server.port) as relay, connect_through(server, relay.port) as through:
        through.operation(operation.id).stop()
        assert relay.cuts == 1
    assert operation.wait(LONG_S).state == "stopped"


@pytest.mark.sim
def test_a_server_that_is_started_again_is_followed_on(tmp_path: Path) -> None:
    with serving(tmp_path) as server, skillc.connect(f"http://127.0.0.1:{server.port}", server.token) as connected:
        connected.cell().set_pace(0.2)
        operation = connected.cell().start("carry_all")
        found, ends = list[Envelope](), list[str]()
        reader = threading.Thread(target=lambda: found.extend(operation.events()))
        waiter = threading.Thread(target=lambda: ends.append(operation.wait().state))
        states = connected.watch()
        assert next(states).state == "operational"
        reader.start()
        waiter.start()
        wait_until(lambda: operation.state, lambda it: it == "running")
        time.sleep(0.3)
        server.process.kill()
        server.process.wait(LONG_S)
        time.sleep(0.5)
        server.process = start_server(tmp_path, server.port)
        reader.join(LONG_S)
        waiter.join(LONG_S)
        assert ends == ["interrupted"] and isinstance(found[-1].event, TaskEnded)
        assert [each.sequence for each in found] == list(range(1, operation.status.events + 1))
        again = operation.continue_as("replan")
        with pytest.raises(skillc.RefusedError):
            operation.continue_as("retry")
        assert (again.wait(LONG_S).state, operation.status.continued_by) == ("succeeded", again.id)
        assert next(each for each in states if isinstance(each, CellStatus)).state in ("off", "operational")
        server.process.send_signal(signal.SIGTERM)
        server.process.wait(LONG_S)


async def read_events(address: ServerAddress, operation: str) -> list[Envelope]:
    connection = Connection(address)
    try:
        return [each async for each in follow_operation(connection, operation, 0)]
    finally:
        await connection.close()


def test_breakpoints_are_changed_from_python(server: RunningServer, connected: skillc.Server) -> None:
    server.put_back()
    operation = connected.cell().start("carry_two", breakpoints=["Load"])
    assert operation.wait_for_pause() == "paused" and operation.breakpoints == ("Load",)
    operation.set_breakpoints("Unload")
    assert operation.breakpoints == ("Unload",)
    operation.resume()
    assert (operation.wait_for_pause(), operation.reason) == ("paused", "breakpoint at Unload")

    async def clear() -> tuple[str, ...]:
        async with skillc.connect_async(f"http://127.0.0.1:{server.port}", server.token) as asynchronous:
            found = await asynchronous.operation(operation.id)
            await found.set_breakpoints()
            return found.status.breakpoints

    assert asyncio.run(clear()) == ()
    operation.stop()
    assert operation.wait().state == "stopped"
