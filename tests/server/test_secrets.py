"""What a server keeps secret: its tokens and its files; and what its audit log says of who changed what."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import httpx
import pytest

from server.running import RunningServer
from server.test_recordings import CARRY
from skillc.errors import ServiceError
from skillc.server.state import open_state


def test_a_file_that_holds_no_token_is_not_overwritten(tmp_path: Path) -> None:
    notes = tmp_path / "notes.txt"
    for text in ("buy milk", "\N{EURO SIGN}"):
        notes.write_text(text, encoding="utf-8")
        with pytest.raises(ServiceError, match="something else than a token"), open_state(tmp_path / "state", notes):
            pass
        assert notes.read_text(encoding="utf-8") == text
    notes.write_text("skillc_of_another_server\n", encoding="ascii")
    with open_state(tmp_path / "state", notes) as state:
        assert state.tokens.find(notes.read_text(encoding="ascii").strip()) is not None


def test_tokens_are_kept_as_hashes_and_not_taken_from_addresses(server: RunningServer) -> None:
    made = server.client.post("/tokens", json={"name": "eve", "role": "view"}).json()["token"]
    for each in (server.folder / "served").rglob("*"):
        if each.is_file() and each.name != "admin.token":
            content = each.read_bytes()
            assert made.encode() not in content and server.token.encode() not in content, each
    with closing(sqlite3.connect(server.folder / "served/server.sqlite")) as database:
        assert ("eve",) in database.execute("SELECT name FROM tokens").fetchall()
    for name in ("token", "access_token", "authorization"):
        assert httpx.get(f"{server.url}/cells", params={name: made}).status_code == 401
        assert server.client.get("/cells", params={name: made}).status_code == 422
    assert made not in str(server.client.get("/audit", params={"limit": 10_000}).json())
    server.client.delete("/tokens/eve")


def test_the_audit_log_says_what_was_commanded_and_edited(server: RunningServer) -> None:
    server.put_back()
    entries = server.client.get("/audit", params={"limit": 10_000}).json()
    operation = server.submit(**CARRY, approve=True)["id"]
    server.wait_for(operation, "planned")
    server.client.post(f"/operations/{operation}/commands", json={"type": "approve"})
    server.wait_for(operation, "running", "succeeded")
    server.client.post(f"/operations/{operation}/stop", json={"reason": "enough\nof it"})
    server.client.post(
        "/cells/yard/world/edits", json={"edits": ["lab:spare-2 a skiros:Product"], "why": "it was found"}
    )
    server.client.post("/cells/yard/world/edits", json={"edits": ["not lab:spare-2"], "why": "it was lost"})
    found = server.client.get("/audit", params={"after": entries[-1]["number"]}).json()
    actions = [each["action"] for each in found]
    assert len(actions) == 5 and all(each.isprintable() for each in actions), actions
    assert '"task":"carry"' in actions[0] and "lab:crate-" in actions[0]
    assert actions[1].endswith('/commands {"type":"approve"}')
    assert '{"reason":"enough\\nof it"}' in actions[2]
    assert "lab:spare-2 a skiros:Product" in actions[3] and "it was found" in actions[3]
