"""A robot of another package, which moves by the wall clock in another process: no truth, no picture, no checkpoint."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from docs.installing import install, use
from foreign_backend.carts import LAB, write_carts
from server.running import RunningServer, serving, wait_until
from skillc.client.connecting import connect
from skillc.client.errors import RefusedError
from skillc.errors import RequestError
from skillc.services.project.backends import list_backends, make_backend, require_backend
from skillc.world import WorldModel, load_scene, load_vocabulary

pytestmark = pytest.mark.slow
CART = f"{LAB}Cart-1"
FAR = {"PositionX 0.5 ; skiros:PositionY 0.3": "PositionX 3.0 ; skiros:PositionY 0.0"}
"""What takes the shelf so far away that there is time for requests on the way."""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Install the package, and return its project."""
    write_carts(tmp_path / "carts")
    install(tmp_path / "carts", tmp_path / "site")
    use(tmp_path / "site", monkeypatch)
    return tmp_path / "carts"


def skillc(project: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "skillc", *words]
    paths = os.environ["PYTHONPATH"]
    return subprocess.run(
        command, cwd=project, env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True, check=False
    )


def test_it_is_found_and_what_is_not_there_is_named_with_what_is(project: Path) -> None:
    assert {"cart", "kinematic", "mujoco"} <= set(list_backends())
    with pytest.raises(RequestError, match=r"no backend `tram`; there are: cart, .*kinematic, mujoco.*\. .*install"):
        require_backend("tram")


def test_two_of_a_name_are_refused(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (project / "pyproject.toml").read_text("utf-8")
    other = text.replace('"cart-backend"', '"other-carts"').replace('"cart_backend:', '"cart:')
    (project / "pyproject.toml").write_text(other, "utf-8")
    install(project, tmp_path / "other")
    use(tmp_path / "other", monkeypatch)
    with pytest.raises(RequestError, match="two backends `cart`, of cart-backend and other-carts"):
        require_backend("cart")


def test_a_task_runs_is_recorded_and_explained(project: Path) -> None:
    ran = skillc(project, "run", "--out", "out", "--signals", "csv", "--json")
    result = json.loads(ran.stdout)
    assert (ran.returncode, result["status"], result["verified"], result["simulated"]) == (0, "succeeded", True, False)
    assert "no film: this backend cannot be drawn" in ran.stderr
    assert "simulated" not in (project / "out/report.html").read_text("utf-8")
    assert (project / "out/signals.csv").read_text("utf-8").count("\n") > 50, "where it says it is, in each tick"
    why = skillc(project, "why", "out", "1")
    assert "Go[by_itself]" in why.stdout, why.stderr
    checked = skillc(project, "replay", "out", "--check")
    assert "not repeated: its cell has a time of its own" in checked.stdout
    reported = skillc(project, "report", "out", "--out", "again")
    assert (reported.returncode, "its cell has a time of its own" in reported.stderr) == (1, True)
    slow = skillc(project, "run", "--pace", "0.5")
    assert (slow.returncode, "the cell has a time of its own" in slow.stderr) == (2, True), slow.stderr


def test_it_stops_when_nobody_is_in_charge_any_more(project: Path) -> None:
    scene = WorldModel(load_scene(project / "cell.ttl", load_vocabulary()))
    cell = make_backend("cart", scene, seed=0)
    try:
        base = cell.cell.base(CART)
        goal = base.pose
        goal.position[0] += 3.0
        base.drive_to(goal)
        assert cell.cell.watchdog.beat("somebody", cell.clock.now)
        assert not base.at_rest
        wait_until(lambda: base.at_rest, bool)
        assert 0.0 < base.pose.position[0] < 2.5
        assert not cell.cell.watchdog.beat("somebody", cell.clock.now), "it is too late"
    finally:
        cell.close()


@pytest.fixture
def server(project: Path, tmp_path: Path) -> Iterator[RunningServer]:
    """A server of a cart whose way is long."""

    def write(folder: Path, _takes_ms: int) -> None:
        write_carts(folder, "yard.ttl", FAR)

    with serving(tmp_path / "served_carts", options=("--backend", "cart"), write=write) as running:
        yield running


def where(server: RunningServer) -> float:
    """Return where the cart says it is, along its way in m."""
    with connect(f"http://127.0.0.1:{server.port}", server.token) as client:
        return next(iter(client.cell().samples(50.0))).things[CART][0]


def test_it_is_served_paused_and_stopped(server: RunningServer) -> None:
    with connect(f"http://127.0.0.1:{server.port}", server.token) as client:
        operation = client.cell().start("carts")
        wait_until(lambda: where(server), lambda x: x > 0.2)
        operation.pause()
        server.wait_for(operation.id, "paused")
        first = where(server)
        time.sleep(0.5)
        assert where(server) == first < 2.8
        operation.resume()
        wait_until(lambda: where(server), lambda x: x > first + 0.1)
        operation.stop()
        server.wait_for(operation.id, "stopped")
        stopped = where(server)
        time.sleep(0.3)
        assert where(server) == stopped < 2.9


def test_what_only_a_simulation_can_do_is_left_out_or_refused(server: RunningServer) -> None:
    model = server.client.get("/cells/yard/model").json()
    assert (model["bodies"], server.client.get("/cells/yard/coverage").json()) == ([], {})
    with connect(f"http://127.0.0.1:{server.port}", server.token) as client:
        cell = client.cell()
        assert (cell.status.backend, cell.status.pace) == ("cart", 1.0)
        with pytest.raises(RefusedError, match="the cell has a time of its own"):
            cell.set_pace(0.5)
        pressed = {"type": "emergency-stop"}
        answer = server.client.post("/cells/yard/disturbances", json=pressed)
        assert "yard is no simulation" in answer.text
        assert cell.rehearse("carts").status == "succeeded", "in a twin, which does not move the cart"
    assert where(server) == 0.0


def test_a_cart_that_does_not_answer_ends_the_task_and_has_to_be_acknowledged(server: RunningServer) -> None:
    operation = server.submit(task="carts")["id"]
    server.wait_for(operation, "running")
    wait_until(lambda: where(server), lambda x: x > 0.1)
    (cart,) = find_carts(server)
    os.kill(cart, signal.SIGKILL)
    assert "Cart-1 does not answer" in server.wait_for(operation, "failed")["reason"]
    assert server.wait_ready("protective-stop")["reason"] == "Cart-1 does not answer"
    answer = server.client.post("/cells/yard/acknowledge", json={})
    assert (answer.status_code, "Cart-1 does not answer" in answer.text) == (409, True)


def find_carts(server: RunningServer) -> list[int]:
    """Return the processes of the carts of a server."""
    found = []
    for each in Path("/proc").glob("[0-9]*"):
        try:
            words = (each / "cmdline").read_bytes().split(b"\0")
            ours = str(server.folder.parent) in (each / "environ").read_text("utf-8", "replace")
        except OSError:
            continue
        if ours and any(word.endswith(b"cart.py") for word in words):
            found.append(int(each.name))
    return found
