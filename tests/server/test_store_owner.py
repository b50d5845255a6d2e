"""The world of a cell belongs to the cell: others are refused, and what they changed meanwhile is found."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

from click.testing import CliRunner, Result
from msgspec import structs

from running_cells.checking import check_cell
from running_cells.yard import find_settings
from server.running import RunningServer, serving, wait_until
from skillc.cli.main import skillc


def carry_beside(folder: Path) -> subprocess.CompletedProcess[str]:
    """Carry a crate in a process of its own, with the store of the cell."""
    store = str(folder / "served" / "cells" / "yard" / "world")
    command = (sys.executable, "-m", "skillc", "run", ".:carry", "crate=lab:crate-4", "to=lab:Goal", "--store", store)
    paths = os.pathsep.join(filter(None, sys.path))
    environment = {**os.environ, "PYTHONPATH": paths}
    options = ("--backend", "kinematic", "--out", str(folder / "out"))
    return subprocess.run((*command, *options), cwd=folder, env=environment, capture_output=True, text=True)


def adopt(cell: str, state: Path) -> Result:
    return CliRunner().invoke(skillc, ["state", "adopt", cell, "--why", "I saw it", "--state", str(state)])


def carry(server: RunningServer, crate: str) -> str:
    submitted = server.submit(task="carry", arguments={"crate": crate, "to": "lab:Goal"})
    return str(server.wait_for(submitted["id"], "succeeded", "failed")["state"])


def find_cell_process(folder: Path) -> int:
    """Return the number of the process of the cell, which the file of its store has."""
    text = (folder / "served" / "cells" / "yard" / "world" / "owner").read_text()
    assert text.startswith("the cell yard (process ")
    return int(text.rpartition(" ")[2].rstrip(")"))


def test_others_do_not_write_to_the_store_of_a_cell_that_runs(tmp_path: Path) -> None:
    with serving(tmp_path, takes_ms=1) as server:
        assert carry(server, "lab:crate-0") == "succeeded"
        first = find_cell_process(tmp_path)
        refused = carry_beside(tmp_path)
        assert refused.returncode == 1 and "Traceback" not in refused.stderr
        assert f"belongs to the cell yard (process {first}), and nobody else may write to it" in refused.stderr
        assert carry(server, "lab:crate-1") == "succeeded"
        os.kill(first, signal.SIGKILL)
        wait_until(lambda: find_cell_process(tmp_path), lambda process: process != first)
        server.wait_ready()
        assert carry_beside(tmp_path).returncode == 1
        assert carry(server, "lab:crate-2") == "succeeded"
    settings = structs.replace(find_settings(tmp_path), folder=str(tmp_path / "served" / "cells" / "yard"))
    assert check_cell(settings)["lab:Goal"] == 3, "no fact was lost"


def test_a_store_that_changed_while_the_cell_was_off_is_found_and_adopted_by_a_person(tmp_path: Path) -> None:
    with serving(tmp_path, takes_ms=1) as server:
        assert carry(server, "lab:crate-0") == "succeeded"
    beside = carry_beside(tmp_path)
    assert beside.returncode == 0, beside.stderr
    with serving(tmp_path, takes_ms=1, state="off") as server:
        off = wait_until(lambda: server.client.get("/cells/yard").json(), lambda it: "facts" in it["reason"])
        assert "does not have the facts that its cell wrote" in off["reason"] and "skillc state adopt" in off["reason"]
        assert server.client.post("/cells/yard/acknowledge").status_code in (409, 503)
        assert server.client.post("/cells/yard/operations", json={"task": "carry_all"}).status_code == 503
        unknown = adopt("yrad", tmp_path / "served")
        assert unknown.exit_code == 2 and "has no cell yrad; it has yard" in unknown.output
        adopted = adopt("yard", tmp_path / "served")
        assert adopted.exit_code == 0, adopted.output
        server.wait_ready()
        history = server.client.get("/cells/yard/world/history", params={"limit": 2}).json()
        assert [each["changes"] for each in history if each["origin"].endswith(": I saw it")] == [[]]
        there = server.client.get("/cells/yard/world", params={"subject": "lab:Goal"}).json()["facts"]
        found = {each["fact"]["object"]["label"] for each in there if each["fact"]["type"] == "relation"}
        assert found == {"lab:crate-0", "lab:crate-4"}
        assert carry(server, "lab:crate-5") == "succeeded"
        refused = adopt("yard", tmp_path / "served")
        assert refused.exit_code == 1 and "belongs to the cell yard (process" in refused.output
