"""Plans with little cost: what skills cost is said in their text, and depends on arguments and facts."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

import skillc as skillc_api
from skillc.cli.main import skillc
from symbolic.ward import write_ward

DRAG = """
## Take `tray` to `to`, slowly, and cheap.
skill Drag {
    in    cart: Cart
    in    tray: Tray
    in    to:   Ward
    infer from: Ward
    pre   there: from contain tray
    pre   here:  cart at from
    pre   away:  not from == to
    post  to contain tray
    post  not from contain tray
    post  cart at to
    post  not cart at from
    duration 60 s
    cost 2 + 3 * to.toll
    uses cart
}
"""
SETTINGS = 'name = "ward"\nedition = 2\n\n[tool.run]\nbackend = "symbolic"\n'


def test_the_sum_of_the_costs_is_minimised(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A skill without a cost has the cost 1; times stay those of the skills."""
    ward = write_ward(tmp_path)
    (ward / "skillc.toml").write_text(SETTINGS, encoding="utf-8")
    terms, tasks, scene = (ward / name for name in ("terms.skill", "tasks.skill", "ward.ttl"))
    declared = terms.read_text().replace("fill(Tray): Number", "fill(Tray): Number\nproperty toll(Ward): Number")
    terms.write_text(declared.replace("    duration 20 s\n", "    duration 20 s\n    cost 30\n") + DRAG)
    tasks.write_text(tasks.read_text().replace('"ward.ttl"\n', '"ward.ttl"\n    minimise cost\n'))
    tolls = scene.read_text().replace("lab:Kitchen a ward:Ward .", "lab:Kitchen a ward:Ward ; ward:toll 2.0 .")
    for place in ("1", "2"):
        tolls = tolls.replace(f"lab:Ward-{place} a ward:Ward ;", f"lab:Ward-{place} a ward:Ward ; ward:toll 1.0 ;")
    scene.write_text(tolls)
    monkeypatch.chdir(ward)
    planned = json.loads(CliRunner().invoke(skillc, ["plan", "deliver", "--planner", "built-in", "--json"]).stdout)
    assert [each["skill"] for each in planned["plan"]] == ["Drag", "Go", "Drag"]
    assert (planned["minimise"], planned["cost"], planned["duration_s"]) == ("cost", 17.0, 130.0)
    assert planned["optimal"] == "proven"
    assert "3 steps, 130 s expected, cost 17, proved optimal" in str(skillc_api.plan("deliver"))
    drawn = CliRunner().invoke(skillc, ["graph", ".", "deliver", "--plan", "--format", "mermaid"]).stdout
    assert "130 s expected, cost 17, proved optimal" in drawn
    quick = skillc_api.plan("deliver", minimise="work")
    assert quick.duration_s == 50.0 and "cost" not in str(quick)
    assert skillc_api.run("deliver").status == "succeeded"
