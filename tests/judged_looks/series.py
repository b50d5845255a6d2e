"""Judges a series of random tasks, one after another; those in the journal in its folder are not judged again."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import msgspec

from judged_looks.verdict import Verdict


def judge_series(
    wanted: Iterable[tuple[int, str]], judge: Callable[[int, str, Path], Verdict], folder: Path
) -> list[Verdict]:
    """Return the verdicts on seeds and kinds; `judge` gets a folder for what it writes."""
    folder.mkdir(parents=True, exist_ok=True)
    journal = folder / "verdicts.jsonl"
    lines = journal.read_bytes().splitlines() if journal.exists() else ()
    known = {(each.seed, each.kind): each for each in (msgspec.json.decode(line, type=Verdict) for line in lines)}
    found = list[Verdict]()
    for case in wanted:
        if case not in known:
            known[case] = verdict = judge(*case, folder)
            with journal.open("ab") as file:
                file.write(msgspec.json.encode(verdict) + b"\n")
            told = f"{verdict.seed} {verdict.kind}: {verdict.said}, {verdict.is_so}: {verdict.why}"
            print(told, file=sys.stderr, flush=True)
        found.append(known[case])
    return found
