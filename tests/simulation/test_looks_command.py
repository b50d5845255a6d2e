"""`--looks`: films show the meshes of a collection, and nothing of a run depends on them."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from menagerie import write_collection
from msgspec import structs

from skillc.cli.main import skillc
from skillc_ontology import catalogue
from skillc_runtime.recording.events import PlanArrived, TaskStarted
from skillc_runtime.recording.reader import TraceReader

PRESENT = "TakePosture(arm: lab:Panda-1)"


@pytest.fixture
def cache(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where the collection's folders belong; the cache is empty and Git has nothing but files."""
    monkeypatch.setenv("GIT_ALLOW_PROTOCOL", "file")
    (sheet,) = (text for path, text in catalogue.vocabulary_files() if path.endswith("menagerie.ttl"))
    commit = next(word.strip('"') for word in sheet.split() if len(word.strip('"')) == 40)
    return own_cache / "looks/menagerie" / commit


def run(*words: str) -> Result:
    return CliRunner().invoke(skillc, ["run", "--scene", "panda_desk", "--call", PRESENT, *words])


@pytest.mark.sim
def test_a_run_is_the_same_with_other_looks(tmp_path: Path, cache: Path) -> None:
    write_collection(cache)
    told = []
    for looks in ("primitive", "menagerie"):
        out = tmp_path / looks
        result = run("--looks", looks, "--out", str(out), "--film-quality", "draft")
        assert result.exit_code == 0, result.output
        started, *rest = TraceReader(out / "events.jsonl").events
        assert isinstance(started, TaskStarted) and started.settings.looks == looks
        same = structs.replace(started.settings, looks="", out=None)
        # In which tick the plan arrives depends on the machine; no time passes before.
        later = [structs.replace(each, tick=0) if isinstance(each, PlanArrived) else each for each in rest]
        told.append([structs.replace(started, settings=same), *later])
    assert told[0] == told[1] and len(told[0]) > 3


def test_what_cannot_be_drawn_is_told_before_anything_moves(tmp_path: Path, cache: Path) -> None:
    result = run("--looks", "menagerie", "--out", str(tmp_path / "out"))
    assert result.exit_code == 1
    assert "error: the models of menagerie are not in the cache and cannot be fetched" in result.stderr
    assert f"into {cache}" in result.stderr
    assert result.stdout == "" and not (tmp_path / "out").exists()


def test_looks_that_there_are_not_are_told(tmp_path: Path) -> None:
    result = run("--looks", "menagery", "--out", str(tmp_path))
    assert result.exit_code == 1
    assert "error: there are no looks menagery; there are primitive, menagerie" in result.stderr


@pytest.mark.parametrize("words", [["run", "clean_table"], ["demo"]])
def test_looks_without_pictures_are_a_wrong_command_line(words: list[str]) -> None:
    result = CliRunner().invoke(skillc, [*words, "--looks", "menagerie"])
    assert result.exit_code == 2
    assert "which require --out" in result.stderr
