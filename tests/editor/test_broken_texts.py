"""Whatever is missing from a file, every question about any place in it has an answer."""

from __future__ import annotations

import os
import random
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import pytest

from skillc.services.library.files import SHIPPED, find_library
from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.ide import highlighting, outline
from skillc_compiler.ide.analysis import Analysis, AnalysisInput, analyse
from skillc_compiler.ide.calls import find_signature
from skillc_compiler.ide.completion import complete
from skillc_compiler.ide.descriptions import find_hover
from skillc_compiler.ide.project_names import ProjectNames, find_definitions, find_references
from skillc_compiler.ide.rename import rename
from skillc_dsl.edits import apply_fixes
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

ROUNDS = int(os.environ.get("SKILLC_EDITOR_ROUNDS", "3"))
FILES = ("wiping/wipe.skill", "wiping/tasks.skill", "std/handling.skill", "std/driving.skill")
TOKENS = ("{", "}", "(", ")", '"', ":", ",", "->", "seq", "skill", "3 N", "lab:", "##", "\n", "🦾", "not", ".")
remembered = lru_cache(256)(parse)


def broken(text: str, chance: random.Random) -> str:
    """Return a text with a stretch of it cut out or something put in."""
    start = chance.randrange(len(text))
    return text[:start] + chance.choice(("", chance.choice(TOKENS))) + text[start + chance.choice((0, 1, 5, 40, 400)) :]


def understood(text: str) -> Analysis:
    """Analyse a text as the only file of a library."""
    around = find_library(SHIPPED / "std").importable
    return analyse(AnalysisInput("l", {"a.skill": Source("a.skill", text)}, around, load_vocabulary()), remembered)


@pytest.mark.parametrize("name", FILES)
def test_every_place_of_a_broken_file_has_answers(name: str) -> None:
    whole = (Path(SHIPPED) / name).read_text("utf-8")
    asked = 0
    for seed in range(ROUNDS):
        chance = random.Random(f"{name} {seed}")
        text = broken(broken(whole, chance), chance)
        analysis = understood(text)
        covered = highlighting.highlight_words(analysis, "a.skill")
        assert all(one.span < other.span for one, other in pairwise(covered))
        folds = outline.find_folds(Source("a.skill", text), analysis.program.files[0].file)
        assert all(fold.first < fold.last for fold in folds)
        for _ in range(12):
            asked += ask_at_any_place(analysis, text, chance)
    assert asked == 12 * ROUNDS


def ask_at_any_place(analysis: Analysis, text: str, chance: random.Random) -> int:
    """Ask everything about a place of a text, and check what holds of every answer; return that it was asked."""
    lines = text.split("\n")
    line = chance.randrange(len(lines))
    place = ("a.skill", line + 1, chance.randrange(len(lines[line]) + 1) + 1)
    found = complete(analysis, *place, ["scene.ttl"], ["unused-let"])
    assert found.replaced.end_column == place[2]
    assert len({(offer.text, offer.kind) for offer in found.offers}) == len(found.offers)
    told = find_hover(analysis, *place)
    assert told is None or told.markdown
    find_signature(analysis, *place)
    names = ProjectNames(analysis)
    declared = find_definitions(names, *place)
    named = find_references(names, *place, declarations=True)
    assert not declared or not named or set(named) >= {span for span in declared if span.path == "a.skill"}
    if chance.random() < 0.05:
        after = lambda edits: understood(apply_fixes(text, edits)).problems  # noqa: E731
        rename(names, *place, "renamed", analysis.problems, after)
    return 1
