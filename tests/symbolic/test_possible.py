"""What is possible only after a skill: it happens in a run, and no plan counts on it."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

LIBRARY = """\
use skiros
prefix lab: <http://example.org/lab#>

class    Rack < Location
class    Tip < Product
class    Sample < Product
property isMixed(Sample): Bool

## Mix `sample` with a fresh tip out of `rack`.
skill Mix {
    in   rack:   Rack
    in   sample: Sample
    post some tip: Tip (not rack contain tip where rack contain tip)
    post mixed: sample.isMixed == true
}

## Mix all samples in `tray` that are not mixed yet, each with a tip of its own.
skill MixAll {
    in   rack: Rack
    in   tray: Location
    post forall s: Sample (s.isMixed == true when tray contain s and not s.isMixed == true)
    post possible forall t: Tip (not rack contain t when rack contain t)
}

impl waiting of Mix {
    run python "skillc.primitives:StandIn"
}

impl one_by_one of MixAll {
    do for s: Sample where tray contain s and not s.isMixed == true { Mix(rack, sample: s) }
}

test each_takes_a_tip {
    scene "s.ttl"
    do MixAll(rack: lab:R, tray: lab:T)
    expect lab:S1.isMixed == true and lab:S2.isMixed == true
    expect count(t: Tip where lab:R contain t) == 1
}
test plans_without_it {
    scene "s.ttl"
    goal lab:S1.isMixed == true and lab:S2.isMixed == true
    expect lab:S2.isMixed == true
}
"""
SCENE = """\
@prefix lab: <http://example.org/lab#> .
@prefix mix: <https://w3id.org/skillc/library/mix#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Sc a skiros:Scene ; skiros:contain lab:R, lab:T .
lab:R a mix:Rack ; skiros:contain lab:A, lab:B, lab:C .
lab:T a skiros:Location ; skiros:contain lab:S1, lab:S2 .
lab:A a mix:Tip . lab:B a mix:Tip . lab:C a mix:Tip .
lab:S1 a mix:Sample . lab:S2 a mix:Sample .
"""


@pytest.mark.slow
def test_a_loop_takes_one_in_each_round_and_plans_do_without_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mix.skill").write_text(LIBRARY, "utf-8")
    Path("s.ttl").write_text(SCENE, "utf-8")
    Path("skillc.toml").write_text('name = "mix"\nedition = 2\n[tool.run]\nbackend = "symbolic"\n', "utf-8")
    checked = CliRunner().invoke(skillc, ["check", "."])
    assert checked.output.count("[unplannable-construct]") == 1 and "1 warning in" in checked.output, checked.output
    tested = CliRunner().invoke(skillc, ["test", "."])
    assert "2 tests, all passed" in tested.output, tested.output
    goal = "lab:S1.isMixed == true and lab:S2.isMixed == true"
    planned = CliRunner().invoke(skillc, ["plan", "--scene", "s.ttl", "--goal", goal])
    assert "2 steps" in planned.output and "planned without MixAll: after it `forall t: Tip" in planned.output
