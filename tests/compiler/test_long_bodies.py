"""Bodies of many calls: paths may be long, and a step from a state in which much is known counts as several."""

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.analysis import nodes
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source

LOAD = "skill Load {\n in l: Location\n in p: Product\n post l contain p\n}\n"


def problems(parameters: str, calls: str) -> set[str]:
    """Return the names of the problems with a body."""
    head = f"use skiros\n{LOAD}skill S {{\n in l: Location\n in p: Product\n{parameters} post l contain p\n}}\n"
    text = f"{head}impl i of S {{\n do seq {{\n{calls}  Load(l: l, p: p)\n }}\n}}\n"
    outcome = compile([Source("a.skill", text)], vocabulary(), shelf(), "own")
    return {each.name for each in outcome.diagnostics}


@pytest.mark.slow
def test_a_path_may_have_more_steps_than_python_has_frames() -> None:
    assert "not-decided" not in problems("", "  Load(l: l, p: p)\n" * 1500)


def test_what_is_known_at_a_step_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    parameters = "".join(f" in p{number}: Product\n post l contain p{number}\n" for number in range(20))
    calls = "".join(f"  Load(l: l, p: p{number})\n" for number in range(20))
    monkeypatch.setattr(nodes, "MAX_STEPS", 100)
    assert "not-decided" not in problems(parameters, calls)
    monkeypatch.setattr(nodes, "FACTS_A_STEP", 1)
    assert "not-decided" in problems(parameters, calls)
