"""`skillc diff` pairs what is the same in two runs: one more call, or one call less, does not shift all that follow."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc.services.run_diff.alignment import align
from why.projects import invoke, write_project

SKILLS = """use skiros
prefix lab: <http://example.org/lab#>

skill Rest {
    in  spell: Time
    noplan
}
impl still of Rest { do wait spell }

skill Visit {
    in  thing: Product
    opt spell: Time = 0.1 s
    noplan
}
impl before of Visit {
    pre thing.Weight > 1 kg
    do seq { Rest(spell: 0.3 s)  Rest(spell) }
}
impl after of Visit { do Rest(spell) }

task three {
    scene "scene.ttl"
    do seq { Visit(thing: lab:a)  Visit(thing: lab:b, spell: 0.2 s)  repeat 2 { Visit(thing: lab:c) } }
}
task four {
    scene "scene.ttl"
    do seq {
        Visit(thing: lab:d)
        Visit(thing: lab:a)
        Visit(thing: lab:b, spell: 0.4 s)
        repeat 3 { Visit(thing: lab:c) }
    }
}
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:a a skiros:Product ; skiros:Weight 2.0 .
lab:b a skiros:Product ; skiros:Weight 0.2 .
lab:c a skiros:Product ; skiros:Weight 0.2 .
lab:d a skiros:Product ; skiros:Weight 0.2 .
"""


@pytest.mark.slow
def test_one_more_call_does_not_shift_those_after_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(write_project(tmp_path / "visits", {"s.skill": SKILLS, "scene.ttl": SCENE}))
    for task in ("three", "four"):
        invoke("run", task, "--backend", "kinematic", "--out", task, "--no-film")
    found: dict[str, Any] = json.loads(invoke("diff", "three", "four", "--json").stdout)
    told = [(each["part"], each["what"], each["first"], each["second"]) for each in found["differences"]]
    assert [each for each in told if each[0] != "times"] == [
        ("settings", "task", "three", "four"),
        ("settings", "objective", None, "Visit(thing: d)"),
        ("settings", "objective", "Visit(thing: b, spell: 0.2)", "Visit(thing: b, spell: 0.4)"),
        ("settings", "objective", "repeat 2", "repeat 3"),
        ("plan", "step 1", None, "Visit(thing: lab:d)"),
        ("plan", "step 6", None, "Visit(thing: lab:c)"),
        ("choices", "2/3 Visit.spell", "0.2 s", "0.4 s"),
        ("choices", "2.1/3.1 Rest.spell", "0.2 s", "0.4 s"),
    ]
    assert {each[1] for each in told if each[0] == "times"} == {"whole run", "2/3 Visit", "2.1/3.1 Rest"}
    assert found["compared"]["choices"] == 9


@given(st.lists(st.text("abc", max_size=2), max_size=8), st.lists(st.text("abc", max_size=2), max_size=8))
def test_all_items_are_there_once_in_order_and_those_that_are_equal_first(one: list[str], other: list[str]) -> None:
    pairs = list(align(one, other, lambda item: item, len))
    assert [first for first, _ in pairs if first is not None] == one
    assert [second for _, second in pairs if second is not None] == other
    assert all(len(first) == len(second) for first, second in pairs if first is not None and second is not None)


@given(st.lists(st.integers(0, 9), max_size=9), st.integers(0, 9), st.integers(10, 12))
def test_one_more_item_is_the_only_one_without_a_pair(items: list[int], place: int, more: int) -> None:
    longer = [*items[:place], more, *items[place:]]
    assert [pair for pair in align(items, longer, lambda item: item) if None in pair] == [(None, more)]
