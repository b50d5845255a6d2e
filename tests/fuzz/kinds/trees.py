"""Trees of random libraries in both versions of BehaviorTree.CPP: none is refused, and each runs as it is meant to.

Version 4.8.2 is that of the package `behaviortreepy`, if it is installed; SKILLC_BTCPP names loaders that `make peers`
has built, separated by `:`.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path
from random import Random

from analysis.plays import Writer
from fuzz.kinds._trees import write_library
from peers.comparing import differences
from skillc_compiler.emit import bt
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary

SECONDS = 20
DRAWS = 20


def run_case(random: Random, folder: Path) -> None:
    """Write the trees of a library and run them in each version that is there."""
    files = []
    for name, text in bt.emit(draw_library(random, folder)).items():
        files.append(folder / name.replace("/", "_"))
        files[-1].write_text(text, "utf-8")
    assert files, "a library without trees"
    binaries = [Path(each) for each in os.environ.get("SKILLC_BTCPP", "").split(":") if each]
    problems = [words for path in files for words in differences(path, binaries)]
    assert not problems, "\n".join(problems)


def draw_library(random: Random, folder: Path) -> SkillLibrary:
    """Return a library that compiles, written into the folder."""
    for _ in range(DRAWS):
        text = write_library(random) if random.random() < 0.7 else Writer(random).library()
        (folder / "own.skill").write_text(text, "utf-8")
        outcome = compile([Source("own.skill", text)], _empty(), {}, "own")
        if not any(each.severity == "error" for each in outcome.diagnostics):
            return outcome.value
    raise AssertionError(f"none of {DRAWS} libraries compiles")


@cache
def _empty() -> Vocabulary:
    return load([]).value
