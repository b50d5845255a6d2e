"""Artifacts on the disk: whole or not at all, and nobody else's files are touched."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from emit.samples import wiping
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.emit.headers import add_header
from skillc_compiler.emit.write import EmitError, write


def files(folder: Path) -> dict[str, str]:
    return {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*") if path.is_file()}


def test_what_is_written_can_be_read(tmp_path: Path) -> None:
    made = make_artifacts(wiping())
    paths = write(made, tmp_path / "build")
    assert files(tmp_path / "build") == made
    assert sorted(paths) == sorted(tmp_path / "build" / path for path in made)


def test_what_is_no_longer_made_is_removed_only_if_it_is_ours(tmp_path: Path) -> None:
    ours = add_header("trees/Old.xml", "<root/>\n", wiping())
    write({"trees/Old.xml": ours, "trees/New.xml": ours}, tmp_path)
    (tmp_path / "notes.md").write_text("# my notes\n")
    (tmp_path / "trees/Mine.xml").write_text("<root/>\n")
    write({"trees/New.xml": ours}, tmp_path)
    assert set(files(tmp_path)) == {"trees/New.xml", "trees/Mine.xml", "notes.md"}


@pytest.mark.parametrize("failing", ["write", "fsync", "replace"])
def test_a_full_disk_is_told_and_leaves_no_half_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: str
) -> None:
    write({"domain.pddl": "old"}, tmp_path)

    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    if failing == "replace":
        monkeypatch.setattr(Path, "replace", full)
    elif failing == "fsync":
        monkeypatch.setattr(os, "fsync", full)
    else:
        monkeypatch.setattr("skillc_compiler.emit.write.os.fdopen", full_file)
    with pytest.raises(EmitError, match=r"cannot write .*domain\.pddl: No space left"):
        write({"domain.pddl": "new", "skills.ttl": "new"}, tmp_path)
    monkeypatch.undo()
    assert files(tmp_path) == {"domain.pddl": "old"}


def full_file(descriptor: int, mode: str) -> object:
    """Return a file on a device that is always full."""
    os.close(descriptor)
    return Path("/dev/full").open(mode, buffering=0)


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    (tmp_path / "build").write_text("a file")
    with pytest.raises(EmitError, match="cannot write"):
        write({"trees/A.xml": "x"}, tmp_path / "build")
