"""A run whose claims the simulator contradicts is no success: not printed as one, nor in its exit code."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli import main

SCENE = Path(__file__).parents[1] / "bodies" / "sorting" / "cell.ttl"
LIBRARY = """
prefix lab: <http://example.org/lab#>
use skiros, skillc

skill Put {
    in    part: Product
    in    to:   Container
    infer from: Workstation

    pre   from contain part
    post  to contain part
    post  not from contain part
    duration 2 s
}

impl by_somebody of Put {
    run python "skillc.primitives:StandIn"
}

task put {
    scene "cell.ttl"
    do Put(part: lab:Part-A, to: lab:Bin-A)
}

task nothing {
    scene "cell.ttl"
    goal lab:Cell contain lab:Part-A
}
"""
CLAIM = "lab:Part-A is claimed in lab:Bin-A but lies on lab:Table, 0.42 m away"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a library with a skill that nobody carries out."""
    (tmp_path / "put.skill").write_text(LIBRARY, encoding="utf-8")
    (tmp_path / "cell.ttl").write_text(with_shipped_classes(SCENE.read_text("utf-8")), "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def with_shipped_classes(scene: str) -> str:
    return scene.replace("sorting:WorkPart", "skiros:Product").replace("sorting:Bin", "skiros:Container")


def run(task: str, *words: str) -> Result:
    words = ("run", task, "--backend", "kinematic", "--tick-timeout", "0", *words)
    return CliRunner().invoke(main.skillc, words, catch_exceptions=False)


@pytest.mark.parametrize("options", [(), ("--quiet",)])
def test_a_claim_that_the_simulator_contradicts_is_printed_and_is_the_exit_code(options: tuple[str, ...]) -> None:
    ended = run("put.skill:put", *options)
    assert ended.exit_code == 3, ended.output
    assert ended.stdout.startswith(f"put  false success\ncontradicted by the simulator: {CLAIM}\n")


def test_the_claim_is_in_the_result_and_in_the_recording(folder: Path) -> None:
    assert run("put.skill:put", "--quiet", "--no-film", "--out", "out").exit_code == 3
    result = json.loads((folder / "out" / "result.json").read_text("utf-8"))
    assert (result["status"], result["verified"], result["false_claims"]) == ("succeeded", False, [CLAIM])
    assert CLAIM in (folder / "out" / "report.html").read_text("utf-8")
    why = CliRunner().invoke(main.skillc, ["why", "out"], catch_exceptions=False)
    assert why.stdout.startswith("put: false success") and CLAIM in why.stdout


def test_a_run_whose_claims_are_so_is_a_success() -> None:
    ended = run("put.skill:nothing")
    assert (ended.exit_code, ended.stdout.splitlines()[0]) == (0, "nothing  succeeded")
