"""A mistake in `skillc.toml` is one diagnostic at its line, with what to write instead."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from projects.folders import MANIFEST, call, checked, names, write_project
from skillc.cli.main import skillc
from skillc.services.project.manifest import ToolSettings

MISTAKES = [
    ("name = sorting\n", "broken-manifest", 1, "not TOML"),
    ('name = "sorting"\nname = "twice"\n', "broken-manifest", 2, "cannot overwrite"),
    (f'name = "sorting"\n[tool.run]\nseed = {"9" * 5000}', "broken-manifest", 3, "a number has too many digits"),
    (f'name = "sorting"\nx = {"[" * 5000}', "broken-manifest", 2, "it is nested too deeply"),
    (f'name = "sorting"\n# {"x" * 50_000}', "broken-manifest", 2, "it is longer than 50,000 characters"),
    ('version = "1.0.0"\n', "wrong-setting", 1, "`name` is missing"),
    ('name = "My Sorting"\n', "wrong-setting", 1, "is not a name"),
    ('name = "sorting"\nversion = 1\n', "wrong-setting", 2, "`version`: expected a text, got a whole number"),
    ('name = "sorting"\nnamespace = "https://example.org/sorting"\n', "wrong-setting", 2, "ends with `#` or `/`"),
    ('name = "sorting"\nscenes = "a.ttl"\n', "unknown-key", 2, "there is no key `scenes`"),
    ('name = "sorting"\n[tool.run]\n\nsede = 1\n', "unknown-key", 4, "in `[tool.run]`"),
    ('name = "sorting"\n[tool.run]\nseed = "one"\n', "wrong-setting", 3, "`tool.run.seed`: expected a whole number"),
    ('name = "sorting"\n[tool.run]\nbackend = "mujco"\n', "wrong-setting", 3, "there is no backend `mujco`; there are"),
    ('name = "sorting"\n[tool.fly]\n', "unknown-key", 2, "`fly`"),
    ('name = "sorting"\n[dependencies]\na = { pth = "." }\n', "unknown-key", 3, "`pth`"),
    ('name = "sorting"\n[dependencies]\na = {}\n', "wrong-setting", 3, "needs one of `path`, `package`"),
    ('name = "sorting"\n[dependencies]\na = "1.0"\n', "wrong-setting", 3, "`dependencies.a`: expected a table"),
    ('name = "sorting"\n[dependencies]\na = { path = "nowhere" }\n', "unknown-library", 3, "there is no folder"),
    ('name = "sorting"\n[dependencies]\na = { package = "no.such" }\n', "unknown-library", 3, "no package `no.such`"),
    ('name = "sorting"\n[dependencies]\na = { entry-point = "a" }\n', "unknown-library", 3, "no installed package"),
    ('name = "sorting"\nscene = "iiwa_tabel.ttl"\n', "wrong-setting", 2, "neither in this project nor shipped"),
    ('name = "sorting"\nontology = ["own"]\n', "wrong-setting", 2, 'there is no folder "own"'),
    ('name = "sorting"\ntask = "hold_erasr"\n', "wrong-setting", 2, "there is no task `hold_erasr`"),
    ('name = "sorting"\n[tasks.a]\n', "wrong-setting", 2, "needs either a `goal` or a `call`"),
    (
        'name = "sorting"\n[tasks.a]\nscene = "iiwa_table.ttl"\ngoal = "lab:Tabel-1.isClean == true"\n',
        "unknown-individual",
        4,
        "lab:Tabel-1",
    ),
    ('name = "sorting"\n[tasks.a]\ngoal = "x"\n', "wrong-setting", 2, "has no scene"),
]


@pytest.mark.parametrize(("text", "name", "line", "words"), MISTAKES, ids=[f"{m[1]}-{m[3][:24]}" for m in MISTAKES])
def test_a_mistake_is_one_diagnostic_at_its_line(text: str, name: str, line: int, words: str, tmp_path: Path) -> None:
    skills = write_project(tmp_path / "x", text)
    (skills / "tasks.skill").write_text(TASKS, "utf-8")
    (found,) = checked(skills)
    assert (found["path"], found["name"], found["line"]) == ("skillc.toml", name, line)
    assert words in found["message"]


TASKS = """\
use skiros
prefix lab: <http://example.org/lab#>
import "handling.skill"
task hold_eraser {
    scene "iiwa_table.ttl"
    goal  lab:Robotiq-1 contain lab:Eraser-1
}
"""


def test_a_misspelt_key_has_a_fix_that_works(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", MANIFEST.replace("version", "versoin"))
    (found,) = checked(project)
    assert found["help"] == "did you mean `version`?"


def test_all_unknown_keys_are_reported(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", f"{MANIFEST}colour = 1\n[tool.run]\nspeed = 1\n")
    assert names(checked(project)) == [("unknown-key", 5), ("unknown-key", 7)]


def test_a_manifest_with_errors_ends_every_command_without_traceback(tmp_path: Path) -> None:
    project = write_project(tmp_path / "x", "name = 1\n")
    for command in (["run", "hold_eraser"], ["plan"], ["tasks"], ["world"], ["compile", "-o", "b"], ["lock"]):
        result = call(project, *command)
        assert result.exit_code == 1, command
        assert "skillc.toml:1:1" in result.stderr and "expected a text" in result.stderr, command


@pytest.mark.parametrize("command", [field.name for field in msgspec.structs.fields(ToolSettings)])
def test_each_setting_is_an_option_of_its_command(command: str) -> None:
    settings = getattr(ToolSettings(), command)
    found = skillc.get_command(None, command)  # type: ignore[attr-defined]
    options = {parameter.name for parameter in found.params}
    fields = {field.name for field in msgspec.structs.fields(settings)}
    assert fields and fields <= options
