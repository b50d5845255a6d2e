"""What comes of skills without bodies: drawn or stated, followed by the run, explained and repeated."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from docs.pages import ROOT, blocks
from skillc.cli.main import skillc
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_runtime.execution.tree.stand_ins import choose_outcome


@pytest.fixture
def sorting(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Write the files of the how-to; its tests are followed elsewhere."""
    for block in blocks(ROOT / "docs/how-to/look-then-sort.md"):
        if block.words in ("sorting.skill", "sorting.ttl", "skillc.toml", "tasks.skill"):
            (tmp_path / block.words).write_text(block.text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path


def call(*arguments: str, code: int = 0) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exit_code == code, result.output
    return result


def test_what_comes_is_drawn_by_how_likely_it_is(sorting: Path) -> None:
    outcomes = compile_valid(find_library(sorting)).skills["Look"].outcomes
    drawn = [choose_outcome(outcomes, ("good", "scrap"), str(seed)) for seed in range(1000)]
    assert 850 < drawn.count("good") < 950 and set(drawn) == {"good", "scrap"}
    assert drawn == [choose_outcome(outcomes, ("good", "scrap"), str(seed)) for seed in range(1000)]
    assert {choose_outcome(outcomes, ("scrap",), str(seed)) for seed in range(100)} == {"scrap"}
    assert choose_outcome((), (), "0") == ""


def test_a_policy_is_recorded_and_repeated(sorting: Path) -> None:
    call("run", "sort", "--out", "out", "--tick-timeout", "0")
    assert "the same but for wall times" in call("replay", "--check", "out").stdout
    assert "Look has ended with" in call("why", "out").stdout
    events = [json.loads(line)["event"] for line in Path("out/events.jsonl").read_text().splitlines()]
    made = [each for each in events if each["type"] == "plan-made"]
    assert [each["outcome"] for each in made[0]["branches"]] == ["good", "scrap"] and len(made) == 2


def test_a_policy_is_printed_as_json(sorting: Path) -> None:
    planned = json.loads(call("plan", "sort", "--json").stdout)
    assert planned["worst_s"] == planned["duration_s"] == 7.0
    assert [(each["outcome"], each["plan"][0]["arguments"]["to"]) for each in planned["branches"]] == [
        ("good", "lab:Rack"),
        ("scrap", "lab:Bin"),
    ]
    assert call("plan", "sort", "--minimise", "makespan").stdout.count("Bring") == 2


def test_classical_planners_get_an_action_for_each_outcome(sorting: Path) -> None:
    call("compile", ".", "-o", "build")
    domain = Path("build/domain.pddl").read_text(encoding="utf-8")
    assert "-> good, an outcome" in domain and "-> scrap, an outcome" in domain
