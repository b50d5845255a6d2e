"""PDDL as text: names, costs, and the independent parser that reads every domain back."""

from __future__ import annotations

import re
import traceback

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emit.reading_back import InvalidDomain, read_back
from emit.samples import (
    BASE,
    DRIVE,
    HERE,
    PICK,
    WIPE,
    implementation,
    library,
    need,
    parameter,
    read,
    vocabulary,
    wiping,
)
from skillc_compiler.emit import pddl
from skillc_model.conditions import Arithmetic, Compare, Literal, Variable
from skillc_model.pddl.domain import ComputedCost
from skillc_model.pddl.names import KEYWORDS, assign_object_names
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.pddl.text import format_domain, format_temporal_domain
from skillc_model.skills import Compound, Skill, SkillLibrary
from skillc_model.tree import Call, Sequence


@given(st.sets(st.text(min_size=1, max_size=6), max_size=8))
def test_names_are_legal_unique_and_lead_back(locals_: set[str]) -> None:
    iris = {BASE + each for each in locals_}
    names = assign_object_names(iris, vocabulary(), {"taken"})
    assert set(names.values()) == iris
    assert len(names) == len(iris)
    assert all(re.fullmatch(r"[a-z][a-z0-9-]*", name) for name in names)
    assert KEYWORDS.isdisjoint(names) and "taken" not in names


def test_names_that_only_case_tells_apart_are_kept_apart() -> None:
    names = assign_object_names([f"{BASE}Ur5", f"{BASE}ur5", f"{BASE}UR5"], vocabulary(), ())
    assert len(names) == 3


def test_a_duration_that_depends_on_things_is_a_static_function() -> None:
    seconds = Arithmetic("/", read("from", "weight"), Literal(0.5))
    domain = make_planning_domain(library(msgspec.structs.replace(DRIVE, duration=seconds)))
    assert domain.action["drive"].cost == ComputedCost("cost-drive", ("?from",))
    text = format_domain(domain)
    assert "(cost-drive ?from - place) - number" in text
    assert "(increase (total-cost) (cost-drive ?from))" in text
    assert ":numeric-fluents" not in text
    read_back(text, {"drive"})


def test_a_domain_that_is_not_pddl_is_our_mistake_and_told() -> None:
    text = format_domain(make_planning_domain(wiping()))
    read_back(text, {"drive", "pick", "wipe"})
    with pytest.raises(InvalidDomain, match="not PDDL"):
        read_back(text.replace("(:predicates", "(:predicate"), {"drive", "pick", "wipe"})
    with pytest.raises(InvalidDomain, match="lost an action"):
        read_back(text, {"drive", "pick", "wipe", "fly"})


@pytest.mark.parametrize(
    ("types", "told"),
    [
        ("a - b\n    b - a", "below an undeclared one: `b`"),
        ("a - a", "below an undeclared one: `a`"),
        ("b - nowhere", "below an undeclared one: `nowhere`"),
        ("b -", "below an undeclared one: ``"),
        ("b - object\n    b - object", "declares a type twice: b$"),
        ("b b - object", "declares a type twice: b, b"),
        ("object - object", "declares a type twice: object"),
        ("b", "without a parent: b"),
    ],
)
def test_types_that_are_no_hierarchy_are_our_mistake_and_told(types: str, told: str) -> None:
    text = format_domain(make_planning_domain(wiping()))
    before, end, after = text.partition("\n  )\n")
    assert before.rpartition("(:")[2].startswith("types")
    with pytest.raises(InvalidDomain, match=told):
        read_back(f"{before}\n    {types}{end}{after}", {"drive", "pick", "wipe"})


def test_a_type_that_is_not_declared_is_found_with_any_hierarchy() -> None:
    text = format_domain(make_planning_domain(wiping()))
    with pytest.raises(InvalidDomain, match="not PDDL"):
        read_back(text.replace("- place)", "- places)", 1), {"drive", "pick", "wipe"})


def test_a_deep_hierarchy_of_types_is_read_back() -> None:
    deep = "".join(f"    t{number + 1} - t{number}\n" for number in range(2000))
    text = format_domain(make_planning_domain(wiping()))
    read_back(text.replace("thing - object\n", f"thing - object\n    t0 - thing\n{deep}"), {"drive", "pick", "wipe"})


def test_reading_back_leaves_tracebacks_long() -> None:
    with pytest.raises(InvalidDomain) as refused:
        read_back("(define", set())
    assert traceback.extract_tb(refused.value.__traceback__)


def test_a_library_without_planned_skills_is_a_domain_without_actions() -> None:
    empty = library(msgspec.structs.replace(PICK, planned=False))
    assert "(:action" not in pddl.emit(empty)["domain.pddl"]


def test_what_was_left_out_is_listed_with_place_and_reason() -> None:
    text = format_domain(make_planning_domain(library(msgspec.structs.replace(PICK, post=()), DRIVE)))
    assert "; left out: Pick (sample.skill:1): it changes nothing that a planner can see" in text


def test_hold_conditions_hold_over_all_and_devices_are_locked() -> None:
    text = format_temporal_domain(make_planning_domain(wiping()))
    pick = text[text.index("(:durative-action pick") : text.index("(:durative-action wipe")]
    assert "(over all (guard-pick-ready ?arm))" in pick
    assert "(at start (not (idle ?arm)))" in pick
    assert "(at end (idle ?arm))" in pick
    assert text.count("(") == text.count(")")


def test_an_action_locks_the_devices_of_the_skills_it_calls() -> None:
    move = skill_using("Move", ("arm",))
    grip = skill_using("Grip", ("gripper",))
    nothing = msgspec.structs.replace(WIPE, uses=())
    here, there = Variable("arm"), Variable("gripper")
    calls = (Call("Move", None, {"arm": here}, None, HERE), Call("Grip", None, {"gripper": there}, None, HERE))
    body = Compound(Sequence(calls, False, HERE))
    lanes = msgspec.structs.replace(implementation(nothing, "lanes"), body=body)
    outer = msgspec.structs.replace(nothing, name="Outer", implementations=("all",))
    call = Call("Wipe", None, {"surface": Variable("surface"), "arm": here}, None, HERE)
    around = msgspec.structs.replace(implementation(outer, "all"), body=Compound(call))
    made = make_planning_domain(library(move, grip, nothing, outer, implementations=(lanes, around)))
    assert made.action["wipe"].uses == ("?arm", "?gripper")
    assert made.action["outer"].uses == ("?arm",)
    text = format_temporal_domain(made)
    outer_text = text[text.index("(:durative-action outer") : text.index("(:durative-action wipe")]
    assert [outer_text.count(each) for each in ("(at start (not (idle ?arm)))", "(at end (idle ?arm))")] == [1, 1]


def skill_using(name: str, uses: tuple[str, ...]) -> Skill:
    """Return a skill that a planner does not use, with these devices as its parameters."""
    kinds = {"arm": "Arm", "gripper": "Gripper"}
    parameters = tuple(parameter(each, kinds[each]) for each in uses)
    return Skill(name=name, parameters=parameters, uses=uses, planned=False, implementations=("plain",), source=HERE)


def test_where_nothing_is_locked_nothing_is_said_of_it() -> None:
    assert "idle" not in format_temporal_domain(make_planning_domain(library(msgspec.structs.replace(WIPE, uses=()))))


def test_a_guard_says_which_condition_it_stands_for() -> None:
    for text in pddl.emit(wiping()).values():
        lines = [line.strip() for line in text.splitlines()]
        at = lines.index("(guard-pick-ready ?arm - arm)")
        assert lines[at - 1] == "; `ready` of Pick: arm.deviceState != Fault"


def test_values_that_nothing_reads_are_left_out_of_the_file_and_kept_for_goals() -> None:
    asks = need("dirty", Compare(read("surface", "isClean"), "==", Literal(False)))
    reading = library(msgspec.structs.replace(WIPE, pre=(*WIPE.pre, asks)))
    assert "is-clean-false" in pddl.emit(reading)["domain.pddl"]
    assert "is-clean-false" not in pddl.emit(wiping())["domain.pddl"]
    assert "(is-clean ?surface)" in pddl.emit(wiping())["domain.pddl"]
    assert "is-clean-false" in make_planning_domain(wiping()).predicate


def test_the_table_of_names_may_come_with_the_library() -> None:
    made = wiping()
    bare = SkillLibrary(**{name: getattr(made, name) for name in made.__struct_fields__} | {"names": {}})
    assert make_planning_domain(bare) == make_planning_domain(made)
