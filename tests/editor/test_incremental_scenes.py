"""After edits of skills and scenes the editor tells what one just started tells; `SEQUENCES=50` tries so many."""

from __future__ import annotations

import os
import random
import re
import shutil
from collections import Counter
from itertools import pairwise
from pathlib import Path

import pytest
from single_edits import apply_edits, single_edit

from skillc.lsp.libraries import Libraries
from skillc.services.check import scene_queries
from skillc.services.library.files import SHIPPED
from skillc.services.tasks import scenes as task_scenes
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue

SEQUENCES = int(os.environ.get("SEQUENCES", "2"))
STEPS = 10
BESIDE = ("ur5e_whiteboard.ttl", "iiwa_table.ttl", "panda_desk.ttl")
_NUMBER = re.compile(r"(?<= )-?\d+\.\d+(?= )")


class Author:
    """Edits the shipped library for wiping with three of its scenes, in the editor and on disk."""

    def __init__(self, folder: Path) -> None:
        shutil.copytree(SHIPPED / "wiping", folder)
        for name in BESIDE:
            shutil.copy(catalogue.scene_path(name), folder)
        self.folder, self.libraries = folder, Libraries((folder,))
        self.texts = {file.name: file.read_text("utf-8") for file in sorted(folder.iterdir())}
        for name, text in self.texts.items():
            self.write(name, text)

    def write(self, name: str, text: str) -> None:
        """Type a text."""
        (self.folder / name).write_text(text, encoding="utf-8")
        self.libraries.write((self.folder / name).as_uri(), text)

    def edit(self, chance: random.Random) -> None:
        """Make a mistake or a change in a file, or undo all of them there."""
        name = chance.choice(sorted(self.texts))
        now = (self.folder / name).read_text("utf-8")
        if chance.random() < 0.4:
            self.write(name, self.texts[name])
        elif name.endswith(".skill"):
            self.write(name, apply_edits(now, [single_edit(now, chance.randrange(10**6))]))
        elif chance.random() < 0.5:
            number = chance.choice(list(_NUMBER.finditer(now)))
            self.write(
                name, f"{now[: number.start()]}{float(number[0]) + chance.choice((-0.4, 0.1))}{now[number.end() :]}"
            )
        else:
            lines = now.split("\n")
            del lines[chance.randrange(len(lines))]
            self.write(name, "\n".join(lines))


def told(libraries: Libraries, folder: Path) -> tuple[tuple[Diagnostic, ...], Counter[Diagnostic]]:
    """Return the problems of a library's texts, and those around them."""
    root = libraries.root(folder / "wipe.skill")
    return libraries.analysis(root).problems, Counter(libraries.problems_around(root))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(SEQUENCES))
def test_after_edits_the_editor_tells_what_a_new_one_tells(seed: int, tmp_path: Path) -> None:
    author, chance = Author(tmp_path / "wiping"), random.Random(seed)
    seen = []
    for step in range(STEPS):
        author.edit(chance)
        now = told(author.libraries, author.folder)
        assert now == told(Libraries((author.folder,)), author.folder), f"seed {seed}, step {step}"
        seen.append(now)
    assert any(before != after for before, after in pairwise(seen))


@pytest.mark.slow
def test_an_edit_of_a_scene_or_of_a_body_asks_nothing_of_other_scenes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    author, asked = Author(tmp_path / "wiping"), list[str]()
    before = told(author.libraries, author.folder)
    for module, name in (
        (task_scenes, "read_scene"),
        (scene_queries, "judge_cell"),
        (scene_queries, "explain_unreachable"),
        (scene_queries, "check_angles"),
    ):
        work = getattr(module, name)
        monkeypatch.setattr(module, name, lambda *given, work=work, name=name: asked.append(name) or work(*given))
    author.write("strokes.skill", author.texts["strokes.skill"].replace("blend: 5 mm", "blend: 6 mm"))
    assert told(author.libraries, author.folder) == before
    assert asked == []
    author.write("panda_desk.ttl", f"{author.texts['panda_desk.ttl']}# a comment\n")
    assert told(author.libraries, author.folder) == before
    assert Counter(asked) == {"read_scene": 1, "judge_cell": 1, "explain_unreachable": 1, "check_angles": 1}
