"""Twelve libraries of fields of their own go the whole way: checked, tested, planned, run and exported."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from symbolic.libraries_table import BY_HAND, FOLDER, LIBRARIES, README, describe


@pytest.fixture
def here(request: pytest.FixtureRequest, tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the name of a library in a folder of its own, which is the current one."""
    name = str(request.param)
    shutil.copytree(FOLDER / name, tmp_path / name)
    monkeypatch.chdir(tmp_path / name)
    return name


def call(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


every = pytest.mark.parametrize("here", LIBRARIES, indirect=True)


def test_there_are_twelve() -> None:
    assert len(LIBRARIES) == len(BY_HAND) == 12


def test_the_table_has_their_sizes_and_forms() -> None:
    rows = README.read_text("utf-8")
    assert [each for each in LIBRARIES if describe(each) not in rows] == [], "python -m symbolic.libraries_table"


@every
def test_a_library_has_no_problem_and_its_body_runs(here: str) -> None:
    checked = call("check", ".", "--json")
    assert (checked.exit_code, json.loads(checked.stdout)) == (0, []), checked.output
    ran = call("run", BY_HAND[here], "--seed", "1")
    assert ran.exit_code == 0, ran.output


@pytest.mark.slow
@every
def test_a_library_passes_its_tests_and_its_goal_is_planned_and_reached(here: str) -> None:
    tested = call("test")
    assert tested.exit_code == 0, tested.output
    ran = call("run", "--seed", "1")
    assert ran.exit_code == 0, ran.output


@every
def test_a_library_is_exported(here: str) -> None:
    assert call("compile", ".", "-o", "out").exit_code == 0
    trees = sorted(Path("out/trees").glob("*.xml"))
    roots = [ElementTree.parse(each).getroot() for each in trees]
    assert roots and all(root.tag == "root" for root in roots)
    domain = Path("out/domain.pddl").read_text("utf-8")
    assert domain.count("(:action") >= 3
