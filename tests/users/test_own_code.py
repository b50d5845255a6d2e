"""Primitives and control laws that stand in the folder of a project: found from any folder of it, checked, and held."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.gains import UnknownController, load_own_law
from skillc_runtime.control.laws.own_law import CheckedLaw

LAW = """
class Broken:
    mode = "torque"

    def __init__(self, setup):
        self.setup = setup

    def reset(self, state, q, dq):
        pass

    def command(self, state, reference, compliance, period):
        return 1 / 0


class WithoutMode:
    reset = command = print


class WithoutReset:
    mode = "position"
    command = print
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project of the template `press`, with modules that no other test has."""
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(skillc, ["new", "own_code", "--template", "press"]).exit_code == 0
    (tmp_path / "own_code/laws_of_own_code.py").write_text(LAW)
    monkeypatch.chdir(tmp_path / "own_code/tests")
    return tmp_path / "own_code"


def check(project: Path, controller: str) -> str:
    cell = project / "cell.ttl"
    text = cell.read_text()
    assert text.count('CompliantController "impedance"') == 1
    cell.write_text(text.replace('CompliantController "impedance"', f'CompliantController "{controller}"'))
    before = sys.path[:]
    output = CliRunner().invoke(skillc, ["check", "--format", "concise", ".."]).output
    assert sys.path == before
    return output


@pytest.mark.slow
@pytest.mark.parametrize(
    ("controller", "message"),
    [
        ("laws_of_own_code:Broken", ""),
        ("laws_of_own_code:Missing", "cannot be imported: module 'laws_of_own_code' has no attribute 'Missing'"),
        ("no_such_module:Law", "cannot be imported: No module named 'no_such_module'"),
        ("laws_of_own_code:WithoutMode", "needs an attribute `mode`: torque, position, velocity"),
        ("laws_of_own_code:WithoutReset", "has no `reset`"),
    ],
)
def test_the_law_of_a_project_is_checked(project: Path, controller: str, message: str) -> None:
    output = check(project, controller)
    assert ("unknown-controller" in output) == bool(message)
    assert message in output


def test_what_a_law_raises_holds_the_arm(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(project)
    law = CheckedLaw(load_own_law("laws_of_own_code:Broken", lambda _: 1.0), None)  # type: ignore[arg-type]
    with pytest.raises(ControlError, match="the controller 'laws_of_own_code:Broken' raised ZeroDivisionError"):
        law.command(None, None, None, 0.001)  # type: ignore[arg-type]
    with pytest.raises(UnknownController, match="No module named"):
        load_own_law("no_such_module:Law", lambda _: np.nan)


def test_a_primitive_in_the_folder_of_a_project_is_found(project: Path) -> None:
    (project / "own_primitives_of_own_code.py").write_text(
        "from skillc_runtime.primitives.primitive import Primitive, Status\n\n\n"
        "class Stay(Primitive):\n    def __init__(self, cell, *, arm):\n        super().__init__(cell)\n\n"
        "    def tick(self):\n        return Status.SUCCESS\n"
    )
    (project / "stay.skill").write_text(
        "use rparts\n\n## Stay.\nskill Stay {\n    in arm: ArmDevice\n    noplan\n}\n\n"
        'impl now of Stay {\n    run python "own_primitives_of_own_code:Stay"\n}\n'
    )
    runner = CliRunner()
    assert "python" not in runner.invoke(skillc, ["check", "--format", "concise", ".."]).output
    (project / "own_primitives_of_own_code.py").rename(project / "renamed_of_own_code.py")
    assert "own_primitives_of_own_code" in runner.invoke(skillc, ["check", "--format", "concise", ".."]).output
