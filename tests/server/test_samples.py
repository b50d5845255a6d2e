"""Samples of a cell: what moves, where it is, and who may see them."""

from __future__ import annotations

import asyncio
import json
from itertools import islice
from pathlib import Path

import msgspec
import numpy as np
import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

import skillc
from running_cells.test_condition import TASK, run_until
from running_cells.test_reality import SORTING, make_settings, reality
from server.running import RunningServer, wait_until
from server.test_leases import client_of
from skillc.cells.opening import open_cell
from skillc.cli.progress.attached import CellTime
from skillc.contract.sample import Sample
from skillc.services.reporting.reporter import SilentReporter

ARM, PART = "http://example.org/lab#Arm-1", "http://example.org/lab#Part-A"


def test_a_sample_has_what_moves(tmp_path: Path) -> None:
    with open_cell(make_settings(tmp_path, SORTING, "kinematic"), SilentReporter()) as host:
        host.submit("first", TASK)
        run_until(host, 100)
        first = host.devices.sampler.take()
        run_until(host, 200)
        second = host.devices.sampler.take()
        arm, cell = second.arms[ARM], reality(host)
        assert second.time_s == cell.now > first.time_s
        assert np.allclose(arm.joints, cell.arms[ARM].state().q, atol=0.01) and arm.joints != first.arms[ARM].joints
        assert np.allclose(arm.tool[:3], cell.arm(ARM).measured.pose.position, atol=0.01)
        assert np.allclose(second.things[PART][:3], cell.ground_truth.body_pose(PART).position)
        assert PART in second.things and any(abs(each) > 0.01 for each in arm.speeds)
        assert msgspec.msgpack.decode(msgspec.msgpack.encode(second), type=Sample) == second


def test_samples_go_on_while_a_cell_works(server: RunningServer) -> None:
    server.put_back(pace=0.05)
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    with skillc.connect(f"http://127.0.0.1:{server.port}", state=server.folder / "served") as connected:
        cell = connected.cell()
        samples = list(islice(cell.samples(50.0), 10))
        with pytest.raises(skillc.RefusedError, match="the first message is no valid hello"):
            next(iter(cell.samples(5000.0)))
    times = [each.time_s for each in samples]
    assert {each.cell for each in samples} == {"yard"} and times == sorted(times) and times[-1] > times[0]
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped")


def test_the_clock_of_a_display_goes_on_between_events(server: RunningServer) -> None:
    server.put_back(pace=0.05)
    operation = server.submit(task="carry_all")["id"]
    events = server.wait_for(operation, "running")["events"]
    with skillc.connect(f"http://127.0.0.1:{server.port}", state=server.folder / "served") as connected:
        clock = CellTime(connected.cell())
        first = wait_until(lambda: clock.now_s, bool)
        wait_until(lambda: clock.now_s, lambda now: now > first)
        assert server.client.get(f"/operations/{operation}").json()["events"] == events
    server.client.put("/cells/yard/pace", json={"factor": None})
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped")


@pytest.mark.parametrize(
    ("hello", "said"),
    [
        ({"token": "guessed", "cell": "yard"}, "the token is not valid"),
        ({"token": "", "cell": "garden"}, "there is no cell `garden`"),
        ({"token": "", "cell": "yard", "rate_hz": 0}, "no valid hello"),
        ({"cell": "yard"}, "the token is not valid"),
    ],
)
def test_who_may_not_have_samples_is_told_why(server: RunningServer, hello: dict[str, object], said: str) -> None:
    if hello.get("token") == "":
        hello = {**hello, "token": server.token}

    async def ask() -> str:
        async with connect(f"ws://127.0.0.1:{server.port}/api/v1/samples") as socket:
            await socket.send(json.dumps(hello))
            with pytest.raises(ConnectionClosed) as closed:
                await socket.recv()
            assert closed.value.rcvd is not None
            return closed.value.rcvd.reason

    assert said in asyncio.run(ask())


def test_a_token_that_is_revoked_gets_no_more_samples(server: RunningServer) -> None:
    async def watch(token: str) -> int:
        count = 0
        async with connect(f"ws://127.0.0.1:{server.port}/api/v1/samples") as socket:
            await socket.send(json.dumps({"token": token, "cell": "yard", "rate_hz": 50}))
            with pytest.raises(ConnectionClosed, match="the token is not valid"):
                while True:
                    await socket.recv()
                    count += 1
                    if count == 1:
                        await asyncio.to_thread(server.client.delete, "/tokens/ann")
        return count

    with client_of(server, "ann", "view") as ann:
        assert asyncio.run(watch(ann.headers["Authorization"].removeprefix("Bearer "))) >= 1
