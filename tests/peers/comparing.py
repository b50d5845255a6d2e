"""What BehaviorTree.CPP does with a file of trees, held against what the player does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path

from emit.tree_rules import broken_rules
from peers.loader import loader
from peers.scripted import trace

SHOWN_LINES = 4


def differences(path: Path, binaries: Sequence[Path] = ()) -> Iterator[str]:
    """Yield what is wrong with a file; `binaries` are loaders to run it in."""
    text = path.read_text("utf-8")
    yield from differences_of(path.name, text)
    for binary in binaries:
        yield from _compared(f"{path.name} in {binary.name}", trace(text), loader(binary).trace(path))


def differences_of(name: str, text: str) -> Iterator[str]:
    """Yield the rules that a file breaks, and how it runs otherwise in the library that Python has, if it has one."""
    yield from (f"{name}: {words}" for words in broken_rules(text))
    if not find_spec("behaviortreepy"):
        return
    from peers.bindings import Loaded  # not installed everywhere

    try:
        loaded = Loaded(text)
        found = loaded.run()
    except RuntimeError as error:
        yield f"{name} in behaviortreepy: {error}"
        return
    if loaded.comparable:
        yield from _compared(f"{name} in behaviortreepy", _without_undoing(trace(text)), _without_undoing(found))


def _without_undoing(lines: list[str]) -> list[str]:
    return [line for line in lines if not line.startswith("undo ")]


def _compared(where: str, expected: list[str], found: list[str]) -> Iterator[str]:
    if found == expected:
        return
    at = next((n for n, pair in enumerate(zip(expected, found, strict=False)) if len(set(pair)) > 1), len(expected))
    shown = [
        f"{side}: {line}"
        for side, lines in (("is", found), ("expected", expected))
        for line in lines[at : at + SHOWN_LINES]
    ]
    yield "\n    ".join([f"{where}, line {at}:", *expected[max(0, at - SHOWN_LINES) : at], *shown])
