"""`skillc new`: what it makes has no mistake, and a name that cannot be a library's is refused in words."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc.services.scaffolding.project_templates import TEMPLATES

NAMES = [each.name for each in TEMPLATES]
LONG = ("pick-place", "press", "insert", "inspect", "inspect-by-arm")
"""The templates whose whole lives are left to `make soak`."""


def call(*arguments: str) -> Result:
    return CliRunner().invoke(skillc, arguments)


def test_a_new_library_checks_and_compiles_without_a_word(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    made = call("new", "shelves/wipe_window")
    assert made.exit_code == 0, made.output
    folder = tmp_path / "shelves/wipe_window"
    written = {path.relative_to(tmp_path).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert set(made.stdout.splitlines()) == written
    assert {path.rsplit("/", 1)[-1] for path in written} >= {"wipe_window.skill", "check.yml", ".gitignore"}
    monkeypatch.chdir(folder)
    checked = call("check", ".", "--scene", "cell.ttl", "--format", "concise")
    assert (checked.exit_code, checked.stdout) == (0, "")
    assert call("fmt", "--check", ".").exit_code == 0
    compiled = call("compile", ".", "-o", "build")
    assert compiled.exit_code == 0, compiled.output
    assert "build/trees/WipeWindow.xml" in compiled.stdout.splitlines()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Wipe-Window", "try `wipe_window`"),
        ("2fast", "starting with a letter"),
        ("pick", "`Pick`"),
        ("seq", "cannot be called `seq`"),
        ("wiping", "prefix of a vocabulary"),
        ("lab", "prefix of a vocabulary"),
        ("taken", "already exists"),
        (".", "already exists"),
    ],
)
def test_a_name_that_cannot_be_is_refused(
    name: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").mkdir()
    refused = call("new", name)
    assert refused.exit_code == 2
    assert words in refused.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


def test_each_template_is_listed_and_another_one_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    listed = [line.split()[0] for line in call("new", "--list").stdout.splitlines()]
    assert listed == NAMES == ["pick-place", "wipe", "press", "insert", "inspect", "inspect-by-arm", "blank"]
    refused = call("new", "mine", "--template", "pick_place")
    assert refused.exit_code == 2 and "did you mean `pick-place`" in refused.stderr
    assert call("new").exit_code == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize("template", NAMES)
def test_each_template_checks_formats_and_plans_from_any_folder(
    template: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert call("new", "my_cell", "--template", template).exit_code == 0
    renamed = (tmp_path / "my_cell").rename(tmp_path / "Cell 2")
    monkeypatch.chdir(renamed / "tests")
    checked = call("check", "--format", "concise")
    assert (checked.exit_code, checked.stdout) == (0, "")
    assert call("fmt", "--check", "..").exit_code == 0
    plan = json.loads(call("plan", "--json").stdout)["plan"]
    (chosen,) = (each for each in TEMPLATES if each.name == template)
    assert sorted(step["skill"] for step in plan) == sorted(each.format(skill="MyCell") for each in chosen.steps)


@pytest.mark.early
@pytest.mark.sim
@pytest.mark.parametrize(
    "template", [pytest.param(each, marks=pytest.mark.long if each in LONG else ()) for each in NAMES]
)
def test_each_template_is_tested_and_tried_as_its_ci_file_does(template: str, tmp_path: Path) -> None:
    python, command = sys.executable, str(Path(sys.executable).with_name("skillc"))
    life = f"skillc new my_cell --template {template} && cd my_cell && skillc check && skillc compile -o build"
    life = f"{life} && skillc trials -n 2 --jobs 1 && {python} -m pytest -q -p no:cacheprovider"
    shell = ["sh", "-ec", life.replace("skillc ", f"{command} ")]
    lived = subprocess.run(shell, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert lived.returncode == 0, lived.stdout + lived.stderr
    assert "2 of 2 trials passed" in lived.stdout and "5 passed" in lived.stdout
    steps = re.findall(r"- run: (.*)", (tmp_path / "my_cell/.github/workflows/check.yml").read_text("utf-8"))
    assert [step for step in steps if step.startswith(("skillc", "pytest"))] == [
        "skillc check --format github",
        "skillc compile -o build",
        "pytest",
    ]
