"""The texts of a library are read and changed: nothing of somebody else is overwritten, and nothing else opened."""

from __future__ import annotations

from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any

import httpx
import pytest

from running_cells.yard import SKILLS
from server.running import RunningServer, serving, wait_until
from server.test_leases import client_of
from skillc.server.library_sources import list_sources
from skillc.server.served_library import open_library

FILE = "/libraries/yard/file"


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    folder = tmp_path_factory.mktemp("sources") / "yard"
    folder.mkdir()
    (folder.parent / "secret.skill").write_text("# secret\n")
    (folder / "link.skill").symlink_to(folder.parent / "secret.skill")
    (folder / "beside").symlink_to(folder.parent)
    (folder / ".hidden").mkdir()
    (folder / ".hidden" / "a.skill").write_text("# hidden\n")
    (folder / "notes.txt").write_text("notes")
    (folder / "dos.ttl").write_bytes(b"\xef\xbb\xbf# one\r\n# two\r\n")
    (folder / "latin.ttl").write_bytes(b"# \xe4\n")
    with serving(folder) as running:
        yield running


def read(server: RunningServer, path: str = "yard.skill") -> dict[str, Any]:
    answer = server.client.get(FILE, params={"path": path})
    assert answer.status_code == 200, answer.text
    return dict(answer.json())


def change(client: httpx.Client, text: str, base_hash: str, path: str = "yard.skill") -> httpx.Response:
    return client.put(FILE, params={"path": path}, json={"text": text, "base_hash": base_hash})


def test_its_own_texts_may_be_changed_and_those_that_it_imports_read(server: RunningServer) -> None:
    found = {each["path"]: each["editable"] for each in server.client.get("/libraries/yard/files").json()}
    own = {path for path, editable in found.items() if editable}
    assert own == {"yard.skill", "yard.ttl", "dos.ttl", "latin.ttl"} and found["wiping/wipe.skill"] is False
    shipped = read(server, "wiping/wipe.skill")
    assert "skill Wipe" in shipped["text"] and not shipped["editable"]
    refused = change(server.client, "", shipped["hash"], "wiping/wipe.skill")
    assert refused.status_code == 409 and "copy it to change it" in refused.json()["detail"]


def test_a_change_is_checked_and_taken_for_the_next_operation(server: RunningServer) -> None:
    before = read(server)
    libraries = server.client.get("/libraries").json()
    text = before["text"].replace("wait 100 ms", "wait 110 ms")
    after = change(server.client, text, before["hash"])
    assert after.status_code == 200 and after.json()["hash"] == read(server)["hash"] != before["hash"]
    assert (server.folder / "yard.skill").read_text() == text
    assert server.client.get("/libraries").json()[0]["pending"]
    checked = wait_until(lambda: server.client.get("/libraries").json()[0], lambda it: not it["pending"])
    assert checked["hash"] != libraries[0]["hash"] and checked["problem"] == ""
    wrong = change(server.client, text.replace("skill Load", "skil Load"), after.json()["hash"])
    refused = wait_until(lambda: server.client.get("/libraries").json()[0], lambda it: not it["pending"])
    assert refused["hash"] == checked["hash"] and "yard.skill" in refused["problem"]
    assert change(server.client, text, wrong.json()["hash"]).status_code == 200


def test_what_somebody_else_has_changed_is_not_overwritten(server: RunningServer) -> None:
    before = read(server)
    theirs = before["text"] + "# theirs\n"
    (server.folder / "yard.skill").write_text(theirs)
    refused = change(server.client, before["text"] + "# mine\n", before["hash"])
    assert refused.status_code == 412 and "changed by somebody else" in refused.json()["detail"]
    assert (server.folder / "yard.skill").read_text() == theirs
    assert change(server.client, before["text"], sha256(theirs.encode()).hexdigest()).status_code == 200


def test_line_ends_and_the_byte_order_mark_stay(server: RunningServer) -> None:
    before = read(server, "dos.ttl")
    assert before["text"] == "# one\n# two\n"
    assert change(server.client, "# one\n# three\r\n", before["hash"], "dos.ttl").status_code == 200
    assert (server.folder / "dos.ttl").read_bytes() == b"\xef\xbb\xbf# one\r\n# three\r\n"


def test_what_is_not_utf_8_loses_nothing(server: RunningServer) -> None:
    before = read(server, "latin.ttl")
    refused = change(server.client, before["text"] + "# more\n", before["hash"], "latin.ttl")
    assert refused.status_code == 409 and "UTF-8" in refused.json()["detail"]
    assert (server.folder / "latin.ttl").read_bytes() == b"# \xe4\n"


def test_a_text_that_is_too_large_leaves_the_file_as_it_was(server: RunningServer) -> None:
    before = read(server)
    assert change(server.client, "x" * 2**21, before["hash"]).status_code == 413
    assert read(server) == before and not [*server.folder.glob(".skillc-*")]


def test_who_may_only_operate_changes_no_text(server: RunningServer) -> None:
    before = read(server)
    with client_of(server, "ada", "operate") as ada:
        assert change(ada, "", before["hash"]).status_code == 403
        assert ada.get(FILE, params={"path": "yard.skill"}).status_code == 200
    assert SKILLS.partition("\n")[0] in read(server)["text"]


@pytest.mark.parametrize(
    "path",
    [
        "../secret.skill",
        "link.skill",
        "beside/secret.skill",
        ".hidden/a.skill",
        "notes.txt",
        "./yard.skill",
        "wiping/../../yard.skill",
        "/etc/passwd",
        "new.skill",
        "yard.skill\0",
        "served/admin.token",
    ],
)
def test_nothing_else_is_read_or_written(server: RunningServer, path: str) -> None:
    for answer in (server.client.get(FILE, params={"path": path}), change(server.client, "", "0" * 64, path)):
        assert answer.status_code == 404 and "secret" not in answer.json()["detail"].replace(path, ""), answer.text
    assert (server.folder.parent / "secret.skill").read_text() == "# secret\n"


@pytest.mark.parametrize(
    ("query", "body", "status"),
    [
        ({}, None, 422),
        ({"path": ""}, None, 422),
        ({"path": "a" * 501}, None, 422),
        ({"path": "yard.skill"}, {"text": "x"}, 422),
        ({"path": "yard.skill"}, {"text": "x", "base_hash": "../"}, 422),
        ({"path": "yard.skill"}, {"text": 1, "base_hash": "0" * 64}, 422),
    ],
)
def test_a_wrong_request_is_refused(
    server: RunningServer, query: dict[str, str], body: dict[str, Any] | None, status: int
) -> None:
    send = server.client.get(FILE, params=query) if body is None else server.client.put(FILE, params=query, json=body)
    assert send.status_code == status
    assert server.client.get("/libraries/other/files").status_code == 404


def test_of_a_single_file_the_folder_below_is_not_served(tmp_path: Path) -> None:
    (tmp_path / "one.skill").write_text("use skiros\n")
    (tmp_path / "private").mkdir()
    (tmp_path / "private" / "a.skill").write_text("use skiros\n")
    own = [path for path, each in list_sources(open_library(tmp_path / "one.skill", ())).items() if each.editable]
    assert own == ["one.skill"]
