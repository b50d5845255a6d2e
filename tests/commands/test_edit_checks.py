"""A check that goes on from the last one finds what a check of everything finds; `SEQUENCES=300` tries so many."""

import os
import pickle
import random
from dataclasses import dataclass
from pathlib import Path

import pytest
from shipped import SKILLS
from single_edits import apply_edits, single_edit
from test_libraries import LIBRARIES, text_of

from skillc.services.check.edit_checks import check_edits
from skillc.services.check.known_checks import check_with
from skillc.services.check.library_checks import check_library
from skillc.services.check.snapshots import SNAPSHOT, Snapshot
from skillc.services.library import answer_store
from skillc.services.library.answer_store import AnswerStore
from skillc.services.library.check_inputs import CheckInputs
from skillc.services.library.files import LibraryFiles, find_library
from skillc_dsl.cache import store
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo

WRONG = """
use skiros

skill Wait {
    in thing: Thing
    post thing is Thing
}

impl idle of Wait {
    do seq {
        wait 1 s
    }
}
"""
"""A file with an error that is found in it alone."""
SEQUENCES = int(os.environ.get("SEQUENCES", "2"))
STEPS = 6


@pytest.fixture(autouse=True)
def cache_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of this test's cache, which nothing but the library and what it names invalidates."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(answer_store, "installation_digest", lambda: b"this one")
    return tmp_path / "cache" / "skillc"


@dataclass
class Author:
    """Edits a library on disk."""

    folder: Path
    chance: random.Random

    def begin(self) -> None:
        """Write a library: the shipped skills with or without tasks, or one of another author."""
        self.folder.mkdir()
        shipped = [*(SKILLS / "std").glob("*.skill"), *(SKILLS / "contact").glob("*.skill")]
        match self.chance.randrange(4):
            case 0:
                texts = {"m.skill": text_of(self.chance.choice(LIBRARIES).stem)}
            case 1:
                texts = {path.name: path.read_text("utf-8") for path in shipped}
            case _:
                texts = {path.name: path.read_text("utf-8") for path in shipped if path.stem != "tasks"}
        for name, text in texts.items():
            (self.folder / name).write_text(text, "utf-8")

    def edit(self) -> None:
        """Edit one file, mostly in a body or a signature."""
        path = self.chance.choice(sorted(self.folder.glob("*.skill")))
        text = path.read_text("utf-8")
        edits = [_edit_body, _edit_signature, _make_mistake, _move, _suppress]
        new = self.chance.choices(edits, [6, 8, 1, 1, 1])[0](text, self.chance)
        path.write_text(new, "utf-8")


def _edit_body(text: str, chance: random.Random) -> str:
    """Remove, repeat, move or comment a line of a body, or change a number in it."""
    lines = text.split("\n")
    inside = _body_lines(lines)
    if not inside:
        return text
    here = chance.choice(inside)
    match chance.randrange(6):
        case 4:
            lines[here] = _renumber(lines[here], chance)
        case 5:
            lines[here] = f"{lines[here]}  # it is a comment"
        case change:
            _change_line(lines, here, change, "        # it is a comment")
    return "\n".join(lines)


def _change_line(lines: list[str], here: int, change: int, comment: str) -> None:
    """Remove (0) or repeat (1) a line, write a comment above it (2), or exchange it with that above (3)."""
    match change:
        case 0:
            del lines[here]
        case 1:
            lines.insert(here, lines[here])
        case 2:
            lines.insert(here, comment)
        case _:
            lines[here], lines[here - 1] = lines[here - 1], lines[here]


def _renumber(line: str, chance: random.Random) -> str:
    """Change the digits of a line, but for zeros."""
    return "".join(chance.choice("123") if c.isdigit() and c != "0" else c for c in line)


def _body_lines(lines: list[str]) -> list[int]:
    """Return the numbers of the lines between a line `do .. {` and the end of its declaration."""
    found, inside = [], False
    for number, line in enumerate(lines):
        inside = inside and line != "}"
        found += [number] if inside else []
        inside = inside or line.strip().startswith("do ")
    return found


def _edit_signature(text: str, chance: random.Random) -> str:
    """Change a number outside of bodies, or add, remove, repeat, move or document a line there."""
    lines = text.split("\n")
    within = {*_body_lines(lines)}
    inside = [n for n, line in enumerate(lines) if n not in within and line.startswith("    ") and line.strip()]
    numbered = [n for n in inside if any(each in lines[n] for each in ("range", "=", "duration", "prefer", "keep"))]
    if not inside:
        return text
    here = chance.choice(inside)
    match chance.randrange(9):
        case 0 | 1 | 2 | 3 as change:
            _change_line(lines, here, change, "    ## It is documented.")
        case 4:
            lines.insert(here, f"    opt   more: Length = {chance.randrange(1, 9)} mm")
        case _ if numbered:
            here = chance.choice(numbered)
            lines[here] = _renumber(lines[here], chance)
        case _:
            lines[here] = f"{lines[here]}  # it is a comment"
    return "\n".join(lines)


def _suppress(text: str, chance: random.Random) -> str:
    """Suppress a warning that is found in libraries with tasks, or no longer."""
    if "# allow" in text:
        return "\n".join("" if line.startswith("# allow") else line for line in text.split("\n"))
    lines = text.split("\n")
    named = [number for number, line in enumerate(lines) if line.startswith("skill ")]
    if named:
        lines.insert(chance.choice(named), "# allow unreachable-skill: it is for others")
    return "\n".join(lines)


def _make_mistake(text: str, chance: random.Random) -> str:
    try:
        return apply_edits(text, [single_edit(text, chance.randrange(10**6))])
    except IndexError:  # a text without anything to edit
        return text


def _move(text: str, chance: random.Random) -> str:
    lines = text.split("\n")
    lines.insert(chance.randrange(len(lines)), chance.choice(["", "# it is a comment"]))
    return "\n".join(lines)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(SEQUENCES))
def test_a_check_after_edits_equals_one_of_everything(
    tmp_path: Path, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    author, gone_on, watching = Author(tmp_path / "mine", random.Random(seed)), [], Memo()
    author.begin()
    for step in range(STEPS):
        library = find_library(author.folder)
        gone_on.append(_goes_on(library))
        found = check(author.folder, watching if seed % 2 else None)
        assert found == check_library(library, None), f"step {step}"
        before = {path: path.read_text("utf-8") for path in author.folder.glob("*.skill")}
        author.edit()
        if step % 3 == 2:
            for path, text in before.items():
                path.write_text(text, "utf-8")
            author.edit()
    assert len(gone_on) == STEPS
    assert not gone_on[0]


def check(folder: Path, watching: Memo | None = None) -> tuple[Diagnostic, ...]:
    """Check a library as `skillc check` does, with `--watch` or in a new process, and store what was found."""
    return check_with(watching or Memo(), AnswerStore(), CheckInputs.of(find_library(folder), None))


def _goes_on(library: LibraryFiles) -> bool:
    before = AnswerStore().load(SNAPSHOT, (CheckInputs.of(library, None).around,))
    return isinstance(before, Snapshot) and check_edits(library, before, Memo()) is not None


@pytest.mark.parametrize("damage", [b"", b"x" * 200, pickle.dumps(1), pickle.dumps({"a": 1}), pickle.dumps(Path())])
@pytest.mark.parametrize("whole", [True, False])
def test_what_is_damaged_is_found_anew(tmp_path: Path, cache_folder: Path, damage: bytes, whole: bool) -> None:
    author = Author(tmp_path / "mine", random.Random(0))
    author.folder.mkdir()
    (author.folder / "m.skill").write_text(text_of(LIBRARIES[0].stem), "utf-8")
    check(author.folder)
    kept = [file for file in cache_folder.rglob("*") if file.is_file() and file.parent.name != "check"]
    assert {file.parent.name for file in kept} >= {"snapshot", "findings", "parse"}
    for file in kept:
        if whole:
            file.write_bytes(damage)
        else:
            store(file, damage)
    author.edit()
    assert check(author.folder) == check_library(find_library(author.folder), None)


def test_files_that_need_each_other_keep_their_own_findings(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "m.skill").write_text(WRONG, "utf-8")
    (folder / "terms.skill").write_text('use skiros\nimport "m.skill"\n\nclass Odd < Thing\n', "utf-8")
    first = check(folder)
    assert "m.skill" in {Path(each.span.path).name for each in first if each.severity == "error"}
    assert check(folder) == first == check_library(find_library(folder), None)


def test_another_version_goes_on_from_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    file = folder / "m.skill"
    file.write_text(text_of(LIBRARIES[0].stem), "utf-8")
    check(folder)
    file.write_text(f"{file.read_text('utf-8')}# it is a comment\n", "utf-8")
    assert _goes_on(find_library(folder))
    monkeypatch.setattr(answer_store, "installation_digest", lambda: b"another one")
    assert not _goes_on(find_library(folder))
