"""The state of a server is backed up and pruned while it is used, and restored."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from random import Random
from typing import Any

import pytest
from click.testing import CliRunner, Result
from msgspec import structs

from running_cells.checking import check_cell
from running_cells.yard import CRATES, write_yard
from server.running import NOTHING, RunningServer
from skillc.cells.database import DatabaseError
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.cli.main import skillc
from skillc.contract.operation import OperationRequest
from skillc.services.reporting.reporter import SilentReporter


def state(*arguments: str | Path) -> Result:
    return CliRunner().invoke(skillc, ["state", *map(str, arguments)])


def test_each_backup_of_a_cell_that_works_is_consistent_and_goes_on(tmp_path: Path) -> None:
    settings = write_yard(tmp_path, takes_ms=60)
    served = tmp_path / "served"
    settings = structs.replace(settings, folder=str(served / "cells" / "yard"))
    served.mkdir()
    (served / "server.sqlite").touch()
    chance, backups = Random(0), 0
    for _ in carry(settings, "first"):
        if chance.random() < 0.1:
            backups += 1
            assert state("backup", tmp_path / f"backup-{backups}", "--state", served).exit_code == 0
    assert backups >= 3
    copies = [
        structs.replace(settings, folder=str(tmp_path / f"backup-{number}" / "cells" / "yard"))
        for number in range(1, backups + 1)
    ]
    brought = [check_cell(each)["lab:Goal"] for each in copies]
    assert brought == sorted(brought) and len(set(brought)) > 1
    assert [*carry(copies[1], "second")] and check_cell(copies[1])["lab:Goal"] == CRATES


def test_damage_in_a_journal_is_found_before_anything_is_written(tmp_path: Path) -> None:
    served, sound, journal = tmp_path / "served", tmp_path / "sound", "cells/yard/journal.sqlite"
    settings = structs.replace(write_yard(tmp_path, takes_ms=60), folder=str(served / "cells" / "yard"))
    served.mkdir()
    (served / "server.sqlite").touch()
    for _ in carry(settings, "first"):
        pass
    assert state("backup", sound, "--state", served).exit_code == 0
    for folder in (served, sound):  # the header stays whole: what is behind it is damaged
        content = bytearray((folder / journal).read_bytes())
        content[len(content) // 2 : len(content) // 2 + 8192] = bytes(8192)
        (folder / journal).write_bytes(content)
    before = read_files(served)
    refused = (
        (("backup", tmp_path / "copy", "--state", served), served),
        (("restore", sound, "--state", served), sound),
        (("restore", sound, "--state", tmp_path / "new"), sound),
    )
    for arguments, damaged in refused:
        result = state(*arguments)
        assert result.exit_code == 1 and f"{damaged / journal} is damaged" in result.output
        assert "restore a backup, or move it away to begin a new one" in result.output
    with pytest.raises(DatabaseError, match="is damaged"), open_cell(settings, SilentReporter()):
        pass
    assert read_files(served) == before
    assert not (tmp_path / "copy").exists() and not (tmp_path / "new").exists()


def read_files(folder: Path) -> dict[Path, bytes]:
    return {each: each.read_bytes() for each in folder.rglob("*") if each.is_file() and each.name != "owner"}


def test_old_operations_are_forgotten_and_the_world_stays(server: RunningServer) -> None:
    folder = server.folder / "served"
    first, second = submit_and_stop(server), submit_and_stop(server)
    key = {"Idempotency-Key": "once"}
    first_keyed = submit_and_stop(server, key)
    assert submit_and_stop(server, key) == first_keyed
    going = server.submit(task="carry_all", approve=True)["id"]
    none = state("prune", "--state", folder, "--older-than", "1")
    assert none.exit_code == 0 and "yard: 0 operations are forgotten" in none.output
    time.sleep(0.01)
    assert state("prune", "--state", folder, "--older-than", "0").exit_code == 0
    assert [server.client.get(f"/operations/{each}").status_code for each in (first, second, going)] == [404, 404, 200]
    server.client.post("/cells/yard/stop", json={})
    server.wait_for(going, "stopped")
    second_keyed = submit_and_stop(server, key)
    assert second_keyed != first_keyed, "the key was forgotten with its operation"
    assert state("prune", "--state", folder, "--larger-than", "1kB").exit_code == 0
    assert server.client.get("/cells/yard/operations").json() == []
    again = submit_and_stop(server)
    assert server.client.get(f"/operations/{again}").json()["state"] == "stopped"


def test_the_audit_log_is_exported_and_old_entries_are_removed(server: RunningServer) -> None:
    folder = server.folder / "served"
    submit_and_stop(server)
    exported = [json.loads(line) for line in state("audit", "--state", folder).output.splitlines()]
    assert len(exported) >= 2 and exported == read_audit(server)
    assert "0 entries" in state("prune", "--state", folder, "--audit-older-than", "1").output
    assert exported == read_audit(server)
    pruned = state("prune", "--state", folder, "--audit-older-than", "0")
    assert pruned.exit_code == 0 and f"{len(exported)} entries of the audit log are removed" in pruned.output
    (left,) = read_audit(server)
    assert left["action"] == f"{len(exported)} older entries were removed" and left["number"] > exported[-1]["number"]


def read_audit(server: RunningServer) -> list[Any]:
    """Return all entries of the audit log; the tests before have made more than one page of them."""
    entries: list[Any] = []
    while page := server.client.get("/audit", params={"after": entries[-1]["number"] if entries else 0}).json():
        entries += page
    return entries


def carry(settings: CellSettings, operation: str) -> Iterator[None]:
    """Carry all crates of a yard, and yield after each tick."""
    with open_cell(settings, SilentReporter()) as host:
        host.submit(operation, OperationRequest(task="carry_all"))
        while host.loop.runs:
            if not host.tick():
                host.loop.wait(0.1)
            yield
        host.take_changed()


def submit_and_stop(server: RunningServer, headers: Mapping[str, str] = NOTHING) -> str:
    """Submit an operation that waits for its approval, and stop it; return its id."""
    request = {"task": "carry_all", "approve": True}
    operation = str(server.client.post("/cells/yard/operations", json=request, headers=headers).json()["id"])
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped")
    return operation


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("backup", "copy"), ".skillc is not the state of a server"),
        (("backup", "here", "--state", "here"), "here exists; name a new folder"),
        (("restore", "nowhere"), "nowhere is not a backup of a server"),
        (("prune",), "give --older-than DAYS, --larger-than SIZE or --audit-older-than DAYS"),
        (("audit",), ".skillc is not the state of a server"),
        (("prune", "--larger-than", "much"), "'much' is no size"),
        (("prune", "--older-than", "1", "--state", "nowhere"), "nowhere is not the state of a server"),
    ],
)
def test_what_cannot_be_done_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "server.sqlite").touch()
    refused = state(*arguments)
    assert refused.exit_code == 2 and message in refused.output
