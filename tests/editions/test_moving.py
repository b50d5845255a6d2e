"""`skillc fix --edition` moves a project to the newest edition, with the same meaning, or changes nothing."""

from __future__ import annotations

from pathlib import Path

import pytest

from editions.test_names import FORMER, OWN
from projects.folders import call, write_project
from skillc.services.library.files import find_library
from skillc.services.library.libraries import compile_library
from skillc_dsl.editions import NEWEST
from skillc_model.skills import SkillLibrary

START = """
relation start(Camera, Camera)

skill Turn {
    in   camera: Camera
    in   other:  Camera
    pre  camera start other
    post gone: not camera start other
    duration 1 s
}

impl plain of Turn { do seq {
    wait 1 s
    apply gone
} }
"""
MANIFEST = 'name = "mine"\nversion = "0.1.0"\n'
MOVED = f'name = "mine"\nedition = {NEWEST}\nversion = "0.1.0"\n'
LOCATING = """\
use skiros
import "handling.skill"

skill Locate {
    in   place: Location
    pre  place contain _
    post gone: not place contain _
    duration 1 s
}

impl plain of Locate { do seq {
    wait 1 s
    apply gone
} }
"""
ESCAPED = '[tasks.locate]\nscene = "iiwa_table.ttl"\ncall = "Locate(place: lab:\\u0043ell)"\n'
CALL = '[tasks.locate]\nscene = "iiwa_table.ttl"\ncall = "Locate(place: lab:Cell)"\n'


def _compile(project: Path) -> SkillLibrary:
    compiled = compile_library(find_library(project))
    assert [each for each in compiled.diagnostics if each.severity == "error"] == []
    return compiled.value


def _meaning(library: SkillLibrary, name: str) -> tuple[object, ...]:
    skill = library.skills[name]
    types = [each.type for each in skill.parameters]
    return types, [each.condition for each in skill.pre], [each.effects for each in skill.post]


def test_own_terms_keep_their_meaning(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", MANIFEST, OWN + START)
    call(project, "fmt")
    before = _compile(project)
    result = call(project, "fix", "--edition")
    assert result.exit_code == 0 and "edition 1 is now 2" in result.output
    assert "tasks.skill:7: `Locate` is `mine_Locate` now" in result.output
    assert (project / "skillc.toml").read_text("utf-8") == MOVED
    after = _compile(project)
    assert after.vocabulary.classes.keys() == before.vocabulary.classes.keys()
    assert after.vocabulary.relations.keys() == before.vocabulary.relations.keys()
    assert [_meaning(before, name) for name in ("Turn", "Locate")] == [
        _meaning(after, name) for name in ("Turn", "mine_Locate")
    ]
    assert call(project, "fmt", "--check").exit_code == 0


def test_former_names_become_present_ones(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", MANIFEST.replace("version", "edition = 1 # old\nversion"), FORMER)
    shown = call(project, "fix", "--edition", "--diff")
    assert "+edition = 2 # old" in shown.output and "+impl plain of Bring { do Pick[from_above](" in shown.output
    assert (project / "tasks.skill").read_text("utf-8") == FORMER
    assert call(project, "fix", "--edition").exit_code == 0
    assert (project / "tasks.skill").read_text("utf-8") == FORMER.replace("from_approach", "from_above")
    again = call(project, "fix", "--edition")
    assert (again.exit_code, "nothing was changed" in again.output) == (0, True)


def test_calls_in_the_manifest_get_the_new_names(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", MANIFEST + CALL, LOCATING)
    result = call(project, "fix", "--edition")
    assert result.exit_code == 0, result.output
    assert "skillc.toml:5: `Locate` is `mine_Locate` now" in result.output
    assert (project / "skillc.toml").read_text("utf-8") == MOVED + CALL.replace("Locate(", "mine_Locate(")


@pytest.mark.parametrize(
    ("manifest", "skills", "edition"),
    [(MANIFEST, FORMER.replace("Product", "Prodct"), 1), (MANIFEST + ESCAPED, LOCATING, NEWEST)],
    ids=["before", "after"],
)
def test_what_does_not_compile_is_not_changed(manifest: str, skills: str, edition: int, tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", manifest, skills)
    result = call(project, "fix", "--edition")
    assert result.exit_code == 1
    assert f"nothing was changed: the library does not compile in edition {edition}" in result.output
    assert (project / "tasks.skill").read_text("utf-8") == skills
    assert (project / "skillc.toml").read_text("utf-8") == manifest


def test_a_library_without_a_manifest_is_told_to_write_one(tmp_path: Path) -> None:
    (tmp_path / "a.skill").write_text(FORMER, "utf-8")
    result = call(tmp_path, "fix", "--edition")
    assert result.exit_code != 0 and f"write one with `name` and `edition = {NEWEST}`" in " ".join(
        result.output.split()
    )


def test_fixes_of_diagnostics_are_applied_without_the_option(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", MOVED, f"use skiros\n{FORMER.replace('from_approach', 'from_above')}")
    assert "can be fixed" in call(project, "fix", "--diff").output
    result = call(project, "fix")
    assert result.exit_code == 0 and "fixed" in result.output
