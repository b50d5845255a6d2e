"""PDDL as text: names, costs, and the independent parser that reads every domain back."""

from __future__ import annotations

import re

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emit.samples import BASE, DRIVE, PICK, library, read, vocabulary, wiping
from skillc_compiler.emit import pddl
from skillc_compiler.emit.pddl import DomainRefused, read_back
from skillc_compiler.library.conditions import Arithmetic, Literal
from skillc_compiler.library.pddl.domain import ComputedCost
from skillc_compiler.library.pddl.names import KEYWORDS, object_names
from skillc_compiler.library.pddl.planning import planning_domain
from skillc_compiler.library.pddl.text import domain_text, temporal_text
from skillc_compiler.library.skills import SkillLibrary


@given(st.sets(st.text(min_size=1, max_size=6), max_size=8))
def test_names_are_legal_unique_and_lead_back(locals_: set[str]) -> None:
    iris = {BASE + each for each in locals_}
    names = object_names(iris, vocabulary(), {"taken"})
    assert set(names.values()) == iris
    assert len(names) == len(iris)
    assert all(re.fullmatch(r"[a-z][a-z0-9-]*", name) for name in names)
    assert KEYWORDS.isdisjoint(names) and "taken" not in names


def test_names_that_only_case_tells_apart_are_kept_apart() -> None:
    names = object_names([f"{BASE}Ur5", f"{BASE}ur5", f"{BASE}UR5"], vocabulary(), ())
    assert len(names) == 3


def test_a_duration_that_depends_on_things_is_a_static_function() -> None:
    seconds = Arithmetic("/", read("from", "weight"), Literal(0.5))
    domain = planning_domain(library(msgspec.structs.replace(DRIVE, duration=seconds)))
    assert domain.action["drive"].cost == ComputedCost("cost-drive", ("?from",))
    text = domain_text(domain)
    assert "(cost-drive ?from - place) - number" in text
    assert "(increase (total-cost) (cost-drive ?from))" in text
    assert ":numeric-fluents" not in text
    read_back(text, {"drive"})


def test_a_domain_that_is_not_pddl_is_our_mistake_and_told() -> None:
    text = domain_text(planning_domain(wiping()))
    read_back(text, {"drive", "pick", "wipe"})
    with pytest.raises(DomainRefused, match="not PDDL"):
        read_back(text.replace("(:predicates", "(:predicate"), {"drive", "pick", "wipe"})
    with pytest.raises(DomainRefused, match="lost an action"):
        read_back(text, {"drive", "pick", "wipe", "fly"})


def test_a_library_without_planned_skills_is_a_domain_without_actions() -> None:
    empty = library(msgspec.structs.replace(PICK, planned=False))
    assert "(:action" not in pddl.emit(empty)["domain.pddl"]


def test_what_was_left_out_is_listed_with_place_and_reason() -> None:
    text = domain_text(planning_domain(library(msgspec.structs.replace(PICK, post=()), DRIVE)))
    assert "; left out: Pick (sample.skill:1): it changes nothing that a planner can see" in text


def test_hold_conditions_hold_over_all_and_devices_are_locked() -> None:
    text = temporal_text(planning_domain(wiping()))
    pick = text[text.index("(:durative-action pick") : text.index("(:durative-action wipe")]
    assert "(over all (guard-pick-ready ?arm))" in pick
    assert "(at start (not (idle ?arm)))" in pick
    assert "(at end (idle ?arm))" in pick
    assert text.count("(") == text.count(")")


def test_the_table_of_names_may_come_with_the_library() -> None:
    made = wiping()
    bare = SkillLibrary(**{name: getattr(made, name) for name in made.__struct_fields__} | {"names": {}})
    assert planning_domain(bare) == planning_domain(made)
