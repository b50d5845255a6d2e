"""Angles in scenes that were written in the other unit, as `skillc check` reports them and `--fix` mends them."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix own: <https://w3id.org/skillc/library/doors#> .
lab:Door a own:Door ; skiros:SizeX 0.8 ; skiros:SizeY 0.04 ; skiros:SizeZ 2.0 ; own:swing {swing} ; skillc:yaw {yaw} ;
    skiros:BaseFrameId "map" ; skiros:PositionX 1 ; skiros:PositionY 0 ; skiros:PositionZ 2.0 .
"""
SKILLS = """use skillc

class Door < Furniture
property swing(Door): Angle
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project with a door, whose own property has the dimension `Angle`."""
    (tmp_path / "doors.skill").write_text(SKILLS, "utf-8")
    (tmp_path / "skillc.toml").write_text('name = "doors"\nversion = "0.1.0"\n', "utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    return tmp_path


def check(*more: str) -> str:
    return CliRunner().invoke(skillc, ["check", ".", "--scene", "scene.ttl", *more]).output


@pytest.mark.parametrize(
    ("swing", "yaw", "told", "mended"),
    [
        ("90", "0", "own:swing is read in rad: this is 14.3 turns", "own:swing 1.5708 ;"),
        ("-36", "90", "own:swing is read in rad: this is 5.7 turns", "own:swing -0.628319 ;"),
        ("1.2", "1.5708", "skillc:yaw is read in degrees, and 1.5708 is a rounded multiple of pi/4", "skillc:yaw 90 ;"),
        ("1.2", "-3.14", "skillc:yaw is read in degrees, and -3.14 is a rounded multiple of pi/4", "skillc:yaw -180 ;"),
    ],
)
def test_the_other_unit_is_reported_with_a_fix(project: Path, swing: str, yaw: str, told: str, mended: str) -> None:
    scene = project / "scene.ttl"
    scene.write_text(SCENE.format(swing=swing, yaw=yaw), "utf-8")
    found = check()
    assert "warning[angle-in-other-unit]" in found and told in found
    check("--fix", "--unsafe-fixes")
    assert mended in scene.read_text("utf-8")
    assert "angle-in-other-unit" not in check()


@pytest.mark.parametrize(("swing", "yaw"), [("6.28", "180"), ("-1.5708", "1.5"), ("0.5", "3.1"), ("0", "0.001")])
def test_angles_that_may_be_meant_are_not(project: Path, swing: str, yaw: str) -> None:
    (project / "scene.ttl").write_text(SCENE.format(swing=swing, yaw=yaw), "utf-8")
    found = check()
    assert "angle-in-other-unit" not in found and "error" not in found
