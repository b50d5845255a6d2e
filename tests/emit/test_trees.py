"""The behaviour trees against the rules of BehaviorTree.CPP's format, and the meaning of a few nodes."""

from __future__ import annotations

import re
from collections import Counter
from xml.etree.ElementTree import Element, fromstring

import msgspec
import pytest

from accept import cases, expected
from emit.samples import HERE, PICK, WIPE, holds, implementation, library, need
from skillc_compiler.emit import bt
from skillc_compiler.emit.bt_names import Names, port
from skillc_compiler.library.conditions import Variable
from skillc_compiler.library.skills import Compound, SkillLibrary
from skillc_compiler.library.tree import Call

CHILDREN = {
    "Condition": (0, 0), "Action": (0, 0), "SubTree": (0, 0), "Sleep": (0, 0), "AlwaysSuccess": (0, 0),
    "AlwaysFailure": (0, 0), "Decorator": (1, 1), "Inverter": (1, 1), "ForceSuccess": (1, 1), "Repeat": (1, 1),
    "RetryUntilSuccessful": (1, 1), "RunOnce": (1, 1), "Timeout": (1, 1), "IfThenElse": (2, 3), "Sequence": (1, 99),
    "Fallback": (1, 99), "ReactiveSequence": (1, 99), "ReactiveFallback": (1, 99), "Parallel": (1, 99),
    "Control": (1, 99),
}  # fmt: skip
DECLARED = {"Action", "Condition", "Control", "Decorator", "SubTree"}
FILES = {
    f"{case.name}/{path}": text
    for case in cases()
    for path, text in expected(case).items()
    if path.startswith("trees/")
}


def nodes(root: Element) -> list[Element]:
    return [node for tree in root.findall("BehaviorTree") for node in tree.iter() if node is not tree]


def compounded(fallback: bool = False) -> SkillLibrary:
    """Return a library in which a compound skill calls picking, with two implementations."""
    skill = msgspec.structs.replace(WIPE, implementations=("careful", "plain"), fallback=fallback)
    call = Call("Pick", None, {"arm": Variable("arm"), "object": Variable("tool")}, None, HERE)
    free = need("free", holds("gripper contain tool"))
    careful = implementation(skill, "careful", free, arm="CompliantArm")
    bodies = [msgspec.structs.replace(each, body=Compound(call)) for each in (careful, implementation(skill, "plain"))]
    return library(skill, PICK, implementations=tuple(bodies))


@pytest.mark.parametrize("name", FILES)
def test_a_file_keeps_the_rules_of_the_format(name: str) -> None:
    root = fromstring(FILES[name])
    model = {(each.tag, each.get("ID")) for each in root.findall("TreeNodesModel/*")}
    trees = Counter(tree.get("ID") for tree in root.findall("BehaviorTree"))
    assert root.get("BTCPP_format") == "4"
    assert trees[root.get("main_tree_to_execute")] == 1
    assert set(trees.values()) == {1}
    assert all(len(tree) == 1 for tree in root.findall("BehaviorTree"))
    for node in nodes(root):
        least, most = CHILDREN[node.tag]
        assert least <= len(node) <= most, node.tag
        if node.tag in DECLARED:
            assert (node.tag, node.get("ID")) in model
        if node.tag == "SubTree":
            assert node.get("ID") in trees


@pytest.mark.parametrize("name", FILES)
def test_names_are_legal_and_every_port_in_use_is_declared(name: str) -> None:
    root = fromstring(FILES[name])
    ports = {each.get("ID"): {p.get("name") for p in each if p.tag != "description"} for each in root.iter()}
    for node in (node for node in nodes(root) if node.tag in DECLARED):
        assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", node.get("ID", ""))
        used = {each for each in node.attrib if each not in ("ID", "_description")}
        assert used <= ports[node.get("ID")]
    assert {"_while", "_failureIf"}.isdisjoint(key for node in nodes(root) for key in node.attrib)


def test_hold_conditions_guard_the_body_and_nothing_else() -> None:
    root = fromstring(bt.emit(compounded())["trees/Wipe.xml"])
    guarded = root.find("BehaviorTree[@ID='Wipe']/Sequence/ReactiveSequence")
    assert guarded is not None
    assert [each.get("ID") for each in guarded[:-1]] == ["Wipe_hold_ready", "Wipe_hold_kept"]
    assert guarded[-1].tag == "IfThenElse"


def test_the_first_implementation_that_fits_is_run_and_no_other_after_it_failed() -> None:
    root = fromstring(bt.emit(compounded())["trees/Wipe.xml"])
    choice = next(root.iter("IfThenElse"))
    assert [each.get("ID") for each in choice[0]] == ["Wipe_careful_type_arm", "Wipe_careful_pre_free"]
    assert [each.get("ID") for each in choice[1:]] == ["Wipe_careful", "Wipe_plain"]


def test_fallback_lets_the_next_implementation_take_over() -> None:
    root = fromstring(bt.emit(compounded(fallback=True))["trees/Wipe.xml"])
    choice = next(root.iter("Fallback"))
    assert [each[-1].get("ID") if len(each) else each.get("ID") for each in choice] == ["Wipe_careful", "Wipe_plain"]


def test_no_file_for_skills_that_are_single_actions() -> None:
    assert bt.emit(library(PICK)) == {}


def test_names_of_nodes_stay_apart_from_each_other_and_from_built_in_ones() -> None:
    names = Names()
    chosen = [names.of("Sequence"), names.of("a_b"), names.of("a", "b"), names.of("ä b"), names.of("a_b")]
    assert chosen == ["Sequence_2", "a_b", "a_b_2", "n__b", "a_b"]
    assert (port("name"), port("ID"), port("arm-1")) == ("name_", "ID_", "arm_1")
