"""`skillc serve` says where it serves and how its cells are, and refuses what it cannot serve with a sentence."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from running_cells.yard import write_yard
from skillc.cli.main import skillc


def serve(*arguments: str | Path) -> Result:
    return CliRunner().invoke(skillc, ["serve", *map(str, arguments)])


@pytest.fixture
def yard(tmp_path: Path) -> Path:
    write_yard(tmp_path)
    return tmp_path


def test_a_library_with_errors_is_refused(yard: Path) -> None:
    with (yard / "yard.skill").open("a", encoding="utf-8") as file:
        file.write("task broken { goal lab:Goal contian lab:Start }\n")
    refused = serve(yard, "--cell", yard / "yard.ttl", "--state", yard / "state")
    assert refused.exit_code == 1 and "contian" in refused.output and not (yard / "state").exists()


def test_an_address_in_use_is_refused(yard: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        refused = serve(yard, "--cell", yard / "yard.ttl", "--state", yard / "state", "--bind", f"127.0.0.1:{port}")
    assert refused.exit_code == 1 and f"127.0.0.1:{port} cannot be listened to: " in refused.output


@pytest.mark.parametrize(
    ("options", "code", "message"),
    [
        ((), 2, "name the scene of a cell with --cell FILE"),
        (("--cell", "nowhere.ttl"), 2, "there is no file nowhere.ttl"),
        (("--cell", "yard.ttl", "--bind", "8421"), 2, "--bind 8421: write HOST:PORT"),
        (("--cell", "yard.ttl", "--bind", "0.0.0.0:0"), 2, "0.0.0.0 is not an address of this machine alone"),
        (("--cell", "yard.ttl", "--tls-cert", "chain.pem"), 2, "give both --tls-cert and --tls-key"),
        (("--cell", "yard.ttl", "--behind-proxy", "proxy"), 2, "give the address that the requests of the proxy"),
        (("--cell", "yard.ttl", "--bind", "0.0.0.0:0", "--behind-proxy", "10.0.0.1"), 2, "clients use with --host"),
        (("--cell", "yard.ttl", *("--tls-cert", "yard.ttl", "--tls-key", "yard.ttl")), 1, "are no certificate"),
        (("--cell", "yard.ttl", "--log", "nowhere/log"), 1, "the log nowhere/log cannot be written"),
        (("--cell", "yard.ttl", "--token-file", "nowhere/token"), 1, "nowhere"),
        (("--cell", "yard.ttl", "--cell", "./yard.ttl"), 2, "two scenes have the same name"),
        (("--cell", "yard.ttl", "--state", "yard.skill"), 2, "yard.skill"),
    ],
)
def test_what_cannot_be_served_is_refused(
    yard: Path, monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...], code: int, message: str
) -> None:
    monkeypatch.chdir(yard)
    refused = serve(yard, *options)
    assert (refused.exit_code, message in refused.output) == (code, True), refused.output


def test_a_damaged_database_is_refused(yard: Path) -> None:
    (yard / "state").mkdir()
    (yard / "state" / "server.sqlite").write_bytes(b"SQLite format 3\0" + bytes(range(256)) * 40)
    refused = serve(yard, "--cell", yard / "yard.ttl", "--state", yard / "state", "--bind", "127.0.0.1:0")
    assert refused.exit_code == 1 and "server.sqlite is damaged" in refused.output
