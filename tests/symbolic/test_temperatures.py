"""Temperatures are in kelvin in scenes and in degC in skills and messages, and are compared as what they are."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from symbolic.ward import write_ward

pytestmark = pytest.mark.usefixtures("own_cache")

TERMS = """use skiros
prefix lab: <http://example.org/lab#>

class    Oven < Product
property heat(Oven): Temperature
property stored(Oven): Energy

skill Bake {
    in   oven: Oven
    opt  to:   Temperature = 80 degC
    pre  hot:  oven.heat >= to - 5 K
    pre  near: oven.heat - to < 10 K
    post full: oven.stored == 2 Wh
    duration 1 s
}

impl waiting of Bake {
    run python "skillc.primitives:StandIn"
}

test at_start {
    scene  "ward.ttl"
    do     Bake(oven: lab:Oven-1, to: TO)
    expect EXPECTED
}
"""
OVEN = "\nlab:Oven-1 a <https://w3id.org/skillc/library/oven#Oven> ; "
PROPERTIES = "<https://w3id.org/skillc/library/oven#heat> 353.15 ."


@pytest.mark.parametrize(
    ("to", "expected", "said"),
    [
        ("80 degC", "lab:Oven-1.stored == 7.2 kJ and lab:Oven-1.heat == 80 degC", None),
        ("86 degC", 'failure "lab:Oven-1.heat is 80 degC"', None),
        ("60 degC", 'failure "no answer for `oven.heat - to < 10 K`: 20; needed: < 10"', None),
        ("86 degC", "lab:Oven-1.heat == 80 degC", "heat is 80 degC"),
    ],
)
def test_kelvin_in_the_scene_and_degrees_in_skills(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, to: str, expected: str, said: str | None
) -> None:
    write_oven(tmp_path, monkeypatch, TERMS.replace("TO)", f"{to})").replace("EXPECTED", expected))
    result = CliRunner().invoke(skillc, ["test", "oven.skill"])
    assert (result.exit_code == 0) == (said is None), result.output
    assert said is None or said in result.output


def test_scenes_are_edited_in_degrees(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = write_oven(
        tmp_path, monkeypatch, TERMS.replace("TO)", "80 degC)").replace("EXPECTED", "lab:Oven-1.heat == 80 degC")
    )
    edit = ["scene", "edit", "ward.ttl"]
    refused = CliRunner().invoke(skillc, [*edit, "lab:Oven-1.heat == 5 K"])
    assert refused.exit_code and "heat is in degC, and this is in K" in refused.output
    refused = CliRunner().invoke(skillc, [*edit, "lab:Oven-1.stored == 5 Nm"])
    assert refused.exit_code and "stored is in J, kJ, Wh, kWh, and this is in Nm" in refused.output
    applied = CliRunner().invoke(skillc, [*edit, "lab:Oven-1.heat == 60 degC"])
    assert applied.exit_code == 0 and "333.15" in (folder / "ward.ttl").read_text("utf-8")


def write_oven(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> Path:
    """Write a library with a scene, and work in its folder."""
    scene = (write_ward(tmp_path) / "ward.ttl").read_text("utf-8")
    folder = tmp_path / "oven"
    folder.mkdir()
    (folder / "ward.ttl").write_text(ovens_of(scene), "utf-8")
    (folder / "oven.skill").write_text(text, "utf-8")
    monkeypatch.chdir(folder)
    return folder


def ovens_of(scene: str) -> str:
    """Return the prefixes of a scene with one oven."""
    head = [line for line in scene.splitlines() if line.startswith("@prefix")]
    return "\n".join(head) + OVEN + PROPERTIES
