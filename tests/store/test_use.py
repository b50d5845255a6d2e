"""Stores as the commands use them: the page about them done as it says, and one line for every place that is none."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest
from click.testing import CliRunner

from docs.pages import ROOT, Reader
from skillc.cli.main import skillc

PAGE = ROOT / "docs/stores.md"


@pytest.mark.sim
def test_stores_work_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    assert reader.done == 6


def nobody(_: Path) -> tuple[str, str]:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"http://127.0.0.1:{free.getsockname()[1]}"
    return address, f"{address} does not answer: no server is listening there"


def nothing(folder: Path) -> tuple[str, str]:
    return str(folder / "new"), f"there is no store {folder}/new; name the scene to fill it with"


def a_file(folder: Path) -> tuple[str, str]:
    (folder / "file").touch()
    return str(folder / "file"), f"{folder}/file is a file; a store is a folder, or the address of a SPARQL server"


def other_things(folder: Path) -> tuple[str, str]:
    (folder / "thesis.tex").touch()
    return str(folder), f"{folder} is not a store: it holds thesis.tex; name a new or an empty folder"


@pytest.mark.parametrize("place", [nobody, nothing, a_file, other_things])
def test_what_is_no_store_is_told_in_one_line(tmp_path: Path, place: object) -> None:
    assert callable(place)
    address, expected = place(tmp_path)
    result = CliRunner().invoke(skillc, ["world", "--store", address])
    assert (result.exit_code, result.stdout, result.stderr) == (1, "", f"error: {expected}\n")
    assert not (tmp_path / "new").exists()
