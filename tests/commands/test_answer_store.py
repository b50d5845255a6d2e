"""Answers on disk: what is read is what would be found, whatever other processes write or damage there."""

import pickle
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest
from shipped_sources import TEXTS

from skillc.services.library import answer_store
from skillc.services.library.answer_store import AnswerStore
from skillc_dsl import cache
from skillc_dsl.parsing import reparse
from skillc_dsl.parsing.parser import parse
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.source import Source


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of this test's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "skillc" / "parse"


def again(source: Source) -> object:
    """Parse as a new process does."""
    store = AnswerStore()
    parsed = parse_with(Memo(store), source)
    store.flush()
    return parsed


@pytest.mark.parametrize("text", TEXTS)
def test_what_is_read_is_what_was_parsed(folder: Path, text: str) -> None:
    source = Source("m.skill", text)
    assert again(source) == again(source) == parse(source)
    assert len(list(folder.iterdir())) == 1


def test_a_file_is_parsed_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = Source("m.skill", TEXTS[0])
    first = again(source)
    monkeypatch.setattr(reparse, "parse", lambda _: pytest.fail("it was parsed again"))
    assert again(source) == first


@pytest.mark.parametrize(
    "damage", [b"", b"x", *map(pickle.dumps, (print, 5, ("parse", print), ("parse", Path("x")), ("check", ())))]
)
def test_a_damaged_or_foreign_entry_is_not_read(folder: Path, damage: bytes) -> None:
    source = Source("m.skill", TEXTS[0])
    again(source)
    (entry,) = folder.iterdir()
    cache.store(entry, damage)
    assert again(source) == parse(source)
    entry.write_bytes(damage)
    assert again(source) == parse(source)


def test_another_version_does_not_read_the_entry(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = Source("m.skill", TEXTS[0])
    again(source)
    monkeypatch.setattr(answer_store, "installation_digest", lambda: b"another")
    assert again(source) == parse(source)
    assert len(list(folder.iterdir())) == 2


def test_processes_that_write_the_same_entries_do_not_disturb_each_other(folder: Path) -> None:
    sources = [Source(f"{number % 3}.skill", TEXTS[number % len(TEXTS)]) for number in range(24)]
    with ProcessPoolExecutor(2) as pool:
        found = list(pool.map(again, sources))
    assert found == [parse(source) for source in sources]
