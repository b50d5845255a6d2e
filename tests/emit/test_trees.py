"""The behaviour trees against the rules of BehaviorTree.CPP's format, and the meaning of a few nodes."""

from __future__ import annotations

from xml.etree.ElementTree import fromstring

import msgspec
import pytest

from accept import cases, expected
from emit.samples import HERE, PICK, WIPE, holds, implementation, library, need, number
from emit.tree_rules import broken_rules
from skillc_compiler.emit import bt
from skillc_compiler.emit.bt_names import Names, port
from skillc_compiler.library.conditions import Variable
from skillc_compiler.library.skills import Compound, Primitive, Skill, SkillLibrary
from skillc_compiler.library.tree import Call

ARTIFACTS = [(case.name, path, text) for case in cases() for path, text in expected(case).items()]
FILES = {f"{name}/{path}": text for name, path, text in ARTIFACTS if path.startswith("trees/")}


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
    assert broken_rules(FILES[name]) == []


BREAKING = {
    "the format is not 4": ('BTCPP_format="4"', 'BTCPP_format="3"'),
    "the main tree is missing": ('main_tree_to_execute="Tour_main"', 'main_tree_to_execute="Detour"'),
    "Inverter  has 0 children": ("<AlwaysSuccess />", "<Inverter />"),
    "Action Gone is not declared once": ("<AlwaysSuccess />", '<Action ID="Gone" />'),
    "SubTree Tour_round calls a tree that is not in the file": ('BehaviorTree ID="Tour_round"', 'BehaviorTree ID="X"'),
    "SubTree Tour uses an undeclared port": ('<SubTree ID="Tour" ', '<SubTree ID="Tour" spade="1" '),
    "SubTree Tour leaves out a mandatory port": (' robot="{robot}" first="{first}" stops', " stops"),
    "SubTree Tour hides the default of a port": ('pause="2"', 'pause="{pause}"'),
    "Action Look uses an undeclared port": ('<Action ID="Look" robot', '<Action ID="Look" speed="1" robot'),
}


@pytest.mark.parametrize("words", BREAKING)
def test_the_rules_notice_what_breaks_them(words: str) -> None:
    text = FILES["control/trees/Tour.xml"].replace('<Sleep msec="1500" />', "<AlwaysSuccess />")
    assert broken_rules(text) == []
    before, after = BREAKING[words]
    assert before in text
    assert words in broken_rules(text.replace(before, after))


def nested(implementation_name: str | None) -> str:
    """Return the trees of a skill that calls wiping, passes what is required and maybe chooses the implementation."""
    wipe = msgspec.structs.replace(WIPE, parameters=(*WIPE.parameters, number("limit", default=2.0), number("extra")))
    every = Skill(name="Every", parameters=WIPE.parameters[:1], implementations=("one",), source=HERE)
    call = Call("Wipe", implementation_name, {"surface": Variable("surface")}, None, HERE)
    one = msgspec.structs.replace(implementation(every, "one"), body=Compound(call))
    ways = [msgspec.structs.replace(implementation(wipe, each), body=Primitive("m:C")) for each in ("careful", "plain")]
    both = msgspec.structs.replace(wipe, implementations=("careful", "plain"))
    return bt.emit(library(both, every, implementations=(*ways, one)))["trees/Every.xml"]


def test_a_call_of_a_tree_leaves_out_what_is_inferred_and_passes_the_defaults() -> None:
    assert broken_rules(nested(None)) == []
    called = fromstring(nested(None)).find("BehaviorTree[@ID='Every_one']/SubTree")
    assert called is not None
    passed = {each: called.get(each) for each in called.attrib.keys() - {"ID", "_description"}}
    assert passed == {"surface": "{surface}", "limit": "2"}


def test_a_chosen_implementation_is_looked_up_and_guarded_like_any_other() -> None:
    assert broken_rules(nested("plain")) == []
    root = fromstring(nested("plain"))
    called = root.find("BehaviorTree[@ID='Every_one']/SubTree")
    assert called is not None and called.get("ID") == "Wipe_only_plain"
    steps = root.findall("BehaviorTree[@ID='Wipe_only_plain']/Sequence/*")
    assert [each.get("ID") for each in steps[:2]] == ["Wipe_infer", "Wipe_pre_on"]
    guarded = root.find("BehaviorTree[@ID='Wipe_only_plain']/Sequence/ReactiveSequence")
    assert guarded is not None and guarded[-1].get("ID") == "Wipe_plain"


def test_a_computed_value_says_what_it_reads() -> None:
    root = fromstring(FILES["control/trees/Tour.xml"])
    declared = root.find("TreeNodesModel/Action[@ID='Tour_round_evaluate_milliseconds__1']")
    assert declared is not None
    assert declared.findtext("description") == "Computes: pause * 1000"
    assert [(each.tag, each.get("name")) for each in declared[1:]] == [
        ("input_port", "pause"),
        ("output_port", "value"),
    ]


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
