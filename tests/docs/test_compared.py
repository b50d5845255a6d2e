"""What skillc, Fast Downward and BehaviorTree.CPP make of what the page that compares them has, and `docs/compared`."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest

from docs.pages import ROOT, Reader, blocks
from skillc_runtime.planning.fast_downward.solver import find_fast_downward

PAGE = ROOT / "docs/compared.md"
FOLDER = ROOT / "docs/compared"
PROBLEMS = sorted(each for each in FOLDER.glob("*.pddl") if each.read_text("utf-8").startswith(";"))
TREES = sorted(FOLDER.glob("*.xml"))
TICKS = 6


@pytest.mark.slow
def test_skillc_does_what_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "500")
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    assert reader.done >= 12


def test_attempts_are_quoted_as_they_are() -> None:
    quoted = [each for each in blocks(PAGE) if each.language in ("pddl", "xml")]
    for each in quoted:
        lines = [line.strip() for line in (FOLDER / each.words).read_text("utf-8").splitlines()]
        assert "\n".join(line.strip() for line in each.text.splitlines()) in "\n".join(lines), each.words
    text = PAGE.read_text("utf-8")
    assert quoted and {each.name for each in FOLDER.iterdir() if f"compared/{each.name})" not in text} == set()


@pytest.mark.slow
@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda path: path.stem)
def test_fast_downward_says_what_the_problem_states(problem: Path, tmp_path: Path) -> None:
    programs = find_fast_downward()
    assert programs is not None
    (domain,) = re.findall(r"\(:domain ([\w-]+)\)", problem.read_text("utf-8"))
    command = (*programs.driver, str(FOLDER / f"{domain}.pddl"), str(problem), "--search", "astar(blind())")
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    stated = problem.read_text("utf-8").splitlines()[0].removeprefix("; ")
    if stated.startswith("cost "):
        assert f"Plan cost: {stated.removeprefix('cost ')}" in ran.stdout
    else:
        assert ran.returncode == 31 and f"Got: {stated.removeprefix('refused: ')}" in ran.stdout.replace("(", ""), ran


@pytest.mark.parametrize("tree", TREES, ids=lambda path: path.stem)
def test_a_tree_does_what_it_states(tree: Path) -> None:
    pytest.importorskip("behaviortreepy")
    text = tree.read_text("utf-8")
    script, stated = re.findall(r"<!-- (.*?) -->", text)
    leaves = {name: results.split() for name, results in (each.split(": ") for each in script.split("; "))}
    assert f"4.8.2: {', '.join(play(text, leaves))}" == stated


def play(text: str, leaves: Mapping[str, Sequence[str]]) -> list[str]:
    """Tick a tree whose leaves have these results, the last one for ever, then halt it; return what happened."""
    import behaviortreepy

    factory = behaviortreepy.BehaviorTreeFactory()
    trace: list[str] = []

    def register(name: str, results: list[str]) -> None:
        def next_result(_: Any) -> Any:
            return getattr(behaviortreepy.NodeStatus, results.pop(0) if len(results) > 1 else results[0])

        def start(node: Any) -> Any:
            trace.append(f"start {name}")
            return next_result(node)

        factory.register_simple_stateful_action(name, start, next_result, lambda _: trace.append(f"halt {name}"))

    for name, results in leaves.items():
        register(name, list(results))
    try:
        tree = factory.create_tree_from_text(text)
    except RuntimeError as error:
        return [f"refused: {str(error).rpartition('-> ')[2]}"]
    for _ in range(TICKS):
        status = tree.tick_exactly_once()
        if status != behaviortreepy.NodeStatus.RUNNING:
            break
    tree.halt_tree()
    return [*trace, status.name]
