"""The file that keeps trials: it goes on where it stopped, and takes nothing that does not belong to it."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from skillc_runtime.evaluation.trials.journal import FILE, Heading, JournalError, TrialJournal, find_missing_seeds
from trials.runners import good

HEADING = Heading(task="clean", disturbance="none", skillc="0.1", library="wiping of 12", scene="a.ttl of 34")
OTHER = {
    "format": 9,
    "task": "sweep",
    "disturbance": "push",
    "skillc": "0.2",
    "library": "wiping of 13",
    "scene": "a.ttl of 35",
}


def kept(folder: Path) -> list[int]:
    with TrialJournal(folder, HEADING) as journal:
        return [trial.seed for trial in journal.trials]


def filled(folder: Path, *seeds: int) -> Path:
    with TrialJournal(folder, HEADING) as journal:
        for seed in seeds:
            journal.add(good(seed))
    return folder / FILE


def test_trials_are_kept_whole_and_each_seed_once(tmp_path: Path) -> None:
    filled(tmp_path, 5, 2)
    with TrialJournal(tmp_path, HEADING) as journal:
        journal.add(good(3))
        assert journal.trials == (good(2), good(3), good(5))
        assert find_missing_seeds(range(2, 7), journal.trials) == (4, 6)
    assert kept(tmp_path) == [2, 3, 5]


def test_a_file_that_ends_anywhere_goes_on_after_its_last_whole_line(tmp_path: Path) -> None:
    whole = filled(tmp_path / "whole", 1, 2).read_bytes()
    ends = [place for place, byte in enumerate(whole, 1) if byte == ord("\n")]
    counts = set()
    for length in range(0, len(whole), 37):
        folder = tmp_path / str(length)
        folder.mkdir()
        (folder / FILE).write_bytes(whole[:length])
        lines = sum(end <= length for end in ends)
        assert kept(folder) == [1, 2][: max(0, lines - 1)]
        filled(folder, 1, 2)
        assert (folder / FILE).read_bytes() == whole if lines < 2 else kept(folder) == [1, 2]
        counts.add(lines)
    assert counts == {0, 1, 2}


@pytest.mark.parametrize("field", Heading.__struct_fields__)
def test_trials_of_something_else_are_refused_by_name(field: str, tmp_path: Path) -> None:
    before = filled(tmp_path, 1).read_bytes()
    with pytest.raises(JournalError, match=f"are of another {field}: .*, now it is {OTHER[field]}; take another"):
        TrialJournal(tmp_path, msgspec.structs.replace(HEADING, **{field: OTHER[field]}))
    assert (tmp_path / FILE).read_bytes() == before


def test_a_second_writer_is_refused_while_there_is_a_first(tmp_path: Path) -> None:
    with TrialJournal(tmp_path, HEADING), pytest.raises(JournalError, match="another process is adding trials"):
        TrialJournal(tmp_path, HEADING)
    assert kept(tmp_path) == []


@pytest.mark.parametrize(("content", "line"), [(b"hello\n", 1), (b'{"seed": 1}\n', 1), (b"%s\n{}\n", 2)])
def test_a_file_that_is_no_journal_is_refused_with_the_line(content: bytes, line: int, tmp_path: Path) -> None:
    (tmp_path / FILE).write_bytes(content.replace(b"%s", msgspec.json.encode(HEADING)))
    with pytest.raises(JournalError, match=f"{FILE}, line {line}, is not a record of trials"):
        TrialJournal(tmp_path, HEADING)
