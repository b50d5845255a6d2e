"""What was learned as text: a change of the implementation, compiled before it is written."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from msgspec import structs

from learning.runners import RADIUS, SPEED
from skillc.errors import RequestError, ServiceError
from skillc.services.check.fixing import FileChange
from skillc.services.learning.text import MARK, LearnedValue, change_texts, require_own
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc_model.skills import SkillLibrary

EVIDENCE = (f"{MARK}for clean_table: least time.", "# It was tried.")


@cache
def shipped() -> tuple[LibraryFiles, SkillLibrary]:
    files = find_library(SHIPPED / "wiping")
    return files, compile_valid(files)


def change(
    *values: LearnedValue, files: LibraryFiles | None = None, evidence: tuple[str, ...] = EVIDENCE
) -> FileChange:
    found, library = shipped()
    (changed,) = change_texts(files or found, library, values, evidence)
    return changed


def implementation(change: FileChange) -> list[str]:
    """Return the lines of `wipe_lanes` before its `do`."""
    lines = change.after.split("\n")
    start = next(number for number, line in enumerate(lines) if line.startswith("impl wipe_lanes"))
    return [line.strip() for line in lines[start : lines.index("", start)]]


def test_values_become_refinements_below_their_evidence() -> None:
    changed = change(LearnedValue(SPEED, 0.152), LearnedValue(RADIUS, 7.5))
    assert implementation(changed)[:7] == [
        "impl wipe_lanes of Wipe {",
        "refine arm:    CompliantArm",
        "# Learned for clean_table: least time.",
        "# It was tried.",
        "refine speed:  Speed  = 0.152 m/s",
        "refine radius: Length = 7.5 mm",
        "pre    whole:  not surface hasArea _",
    ]
    assert changed.before.count("\n") + 4 == changed.after.count("\n")


@pytest.mark.slow
def test_what_is_learned_again_takes_the_place_of_the_former() -> None:
    files, _ = shipped()
    once = change(LearnedValue(SPEED, 0.152), LearnedValue(RADIUS, 7.5))
    sources = tuple(each._replace(text=once.after) if each.path == "wipe.skill" else each for each in files.sources)
    twice = change(
        LearnedValue(SPEED, 0.2),
        files=files._replace(sources=sources),
        evidence=(f"{MARK}for clean_desk: least time.",),
    )
    assert implementation(twice)[:6] == [
        "impl wipe_lanes of Wipe {",
        "refine arm:    CompliantArm",
        "refine radius: Length = 7.5 mm",
        "# Learned for clean_desk: least time.",
        "refine speed:  Speed  = 0.2 m/s",
        "pre    whole:  not surface hasArea _",
    ]


def test_a_range_of_a_refinement_stays(tmp_path: Path) -> None:
    (tmp_path / "knock.skill").write_text(
        """skill Knock {
    opt force: Force = 5 N  range 1 N .. 20 N
    opt times: Int   = 2    range 1 .. 9
    noplan
}

impl gently of Knock {
    refine force: Force  range 1 N .. 5 N
    do     wait 1 s
}

task knock {
    scene "iiwa_table.ttl"
    do    Knock()
}
"""
    )
    files = find_library(tmp_path)
    force = structs.replace(
        SPEED, implementation="Knock.gently", parameter="force", unit="N", type="Force", path="knock.skill"
    )
    times = structs.replace(force, parameter="times", unit="", type="Int")
    values = (LearnedValue(force, 2.5), LearnedValue(times, 3))
    (changed,) = change_texts(files, compile_valid(files), values, EVIDENCE)
    assert [line.split() for line in changed.after.split("\n")[7:12]] == [
        ["#", "Learned", "for", "clean_table:", "least", "time."],
        ["#", "It", "was", "tried."],
        ["refine", "force:", "Force", "=", "2.5", "N", "range", "1", "N", "..", "5", "N"],
        ["refine", "times:", "Int", "=", "3"],
        ["do", "wait", "1", "s"],
    ]
    require_own([changed])


def test_a_value_that_does_not_compile_is_not_written() -> None:
    with pytest.raises(ServiceError, match=r"what was learned cannot be written: .*wipe.skill"):
        change(LearnedValue(SPEED, 0.4))


def test_a_shipped_library_is_not_changed() -> None:
    with pytest.raises(
        RequestError, match=r"wipe.skill is shipped with skillc and cannot be changed; copy the library"
    ):
        require_own([change(LearnedValue(SPEED, 0.152))])
