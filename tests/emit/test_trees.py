"""The behaviour trees against the rules of BehaviorTree.CPP's format, and the meaning of a few nodes."""

from __future__ import annotations

import re
from contextlib import nullcontext
from xml.etree.ElementTree import fromstring

import msgspec
import pytest
from hypothesis import given as hypothesis_given
from hypothesis import strategies as st

from accept import cases, expected
from emit.samples import HERE, PICK, WIPE, holds, implementation, library, need, number
from emit.tree_rules import Reader, broken_rules
from peers.comparing import differences_of
from skillc_compiler.emit import bt
from skillc_compiler.emit.bt.names import NodeIds, entry_name, given_port, port_name
from skillc_compiler.emit.bt.ports import format_plain_value
from skillc_compiler.emit.bt.rules import InvalidTree, check_file
from skillc_model.codec import loads
from skillc_model.conditions import Literal, Variable
from skillc_model.skills import Compound, Primitive, Skill, SkillLibrary
from skillc_model.tree import Call

ARTIFACTS = [(case.name, path, text) for case in cases() for path, text in expected(case).items()]
ARTIFACTS_OF = {case.name: expected(case) for case in cases()}
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
def test_a_file_keeps_the_rules_of_the_format_and_runs_in_the_library(name: str) -> None:
    assert list(differences_of(name, FILES[name])) == []


BREAKING = {
    "the format is not 4": ('BTCPP_format="4"', 'BTCPP_format="3"'),
    "the main tree is missing": ('main_tree_to_execute="Tour_main"', 'main_tree_to_execute="Detour"'),
    "Inverter has 0 children": ("<AlwaysSuccess />", "<Inverter />"),
    "Gone is not declared": ("<AlwaysSuccess />", "<Gone />"),
    "Action is written out, which is refused below a ReactiveSequence": ("<AlwaysSuccess />", '<Action ID="Look" />'),
    "Tour_round calls a tree that is not in the file": ('BehaviorTree ID="Tour_round"', 'BehaviorTree ID="X"'),
    "two trees have one ID": ('BehaviorTree ID="Tour_round"', 'BehaviorTree ID="Tour_main"'),
    "two models have one ID": ('<Action ID="Go">', '<Action ID="Look">'),
    "a tree has the ID of a node": ('BehaviorTree ID="Tour_round"', 'BehaviorTree ID="Sequence"'),
    "Tour uses an undeclared port": ('<SubTree ID="Tour" ', '<SubTree ID="Tour" spade="1" '),
    "Tour has a reserved attribute": ('<SubTree ID="Tour" ', '<SubTree ID="Tour" name="1" '),
    "Tour leaves out a mandatory port": (' robot="{robot}" first="{first}" stops', " stops"),
    "Tour hides the default of a port": ('pause="2.0"', 'pause="{pause}"'),
    "Tour is passed what is not of the port's type": ('pause="2.0"', 'pause="2 s"'),
    "the entry pause is int and later double": ('pause="2.0" robot', 'pause="2" robot'),
    "a name means something else to the library": ('"Tour_round"', '"Root"'),
    "Look uses an undeclared port": ("<Look robot", '<Look speed="1" robot'),
}


@pytest.mark.parametrize("words", BREAKING)
def test_the_rules_notice_what_breaks_them(words: str) -> None:
    text = FILES["control/trees/Tour.xml"].replace('<Sleep msec="1500" />', "<AlwaysSuccess />")
    assert broken_rules(text) == []
    before, after = BREAKING[words]
    assert before in text
    assert words in broken_rules(text.replace(before, after))


@pytest.mark.parametrize("words", BREAKING)
def test_what_breaks_a_rule_is_not_written(words: str) -> None:
    text = FILES["control/trees/Tour.xml"].replace('<Sleep msec="1500" />', "<AlwaysSuccess />")
    check_file(fromstring(text))
    harmless = words == "Tour hides the default of a port"
    with nullcontext() if harmless else pytest.raises(InvalidTree):
        check_file(fromstring(text.replace(*BREAKING[words])))


@pytest.mark.parametrize("name", FILES)
def test_names_lead_back_to_the_library(name: str) -> None:
    reader = Reader.of(FILES[name])
    made = loads(ARTIFACTS_OF[name.split("/")[0]]["library.json"].encode(), name)
    found = reader.names()
    assert len(set(found.values())) == len(found)
    for identity, (skill, *rest) in found.items():
        assert skill in ({""} | made.skills.keys()), identity
        assert not rest or not rest[0] or not skill or f"{skill}.{rest[0]}" in made.implementations, identity
    for skill in made.skills.values():
        if skill.name in found:
            ports = set(reader.parameters(skill.name).values())
            assert ports <= {each.name for each in skill.parameters}


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
    assert passed == {"surface": "{surface}", "limit": "2.0"}


def test_a_chosen_implementation_is_looked_up_and_guarded_like_any_other() -> None:
    assert broken_rules(nested("plain")) == []
    root = fromstring(nested("plain"))
    called = root.find("BehaviorTree[@ID='Every_one']/SubTree")
    assert called is not None and called.get("ID") == "Wipe_only_plain"
    steps = root.findall("BehaviorTree[@ID='Wipe_only_plain']/Sequence/*")
    assert [each.tag for each in steps[:2]] == ["Wipe_infer", "Wipe_pre_on"]
    guarded = root.find("BehaviorTree[@ID='Wipe_only_plain']/Sequence/ReactiveSequence")
    assert guarded is not None and guarded[-1].tag == "Wipe_plain"


def test_a_computed_value_says_what_it_reads() -> None:
    root = fromstring(FILES["control/trees/Tour.xml"])
    declared = root.find("TreeNodesModel/Action[@ID='Tour_round_evaluate_milliseconds__1']")
    assert declared is not None
    assert declared.findtext("description") == "Computes: pause * 1000"
    assert [(each.tag, each.get("name"), each.get("type")) for each in declared[2:]] == [
        ("input_port", "pause", "double"),
        ("output_port", "value", "unsigned int"),
    ]


def test_hold_conditions_guard_the_body_and_nothing_else() -> None:
    root = fromstring(bt.emit(compounded())["trees/Wipe.xml"])
    guarded = root.find("BehaviorTree[@ID='Wipe']/Sequence/ReactiveSequence")
    assert guarded is not None
    assert [each.tag for each in guarded[:-1]] == ["Wipe_hold_ready", "Wipe_hold_kept"]
    assert guarded[-1].tag == "IfThenElse"


def test_the_first_implementation_that_fits_is_run_and_no_other_after_it_failed() -> None:
    root = fromstring(bt.emit(compounded())["trees/Wipe.xml"])
    choice = next(root.iter("IfThenElse"))
    assert [each.tag for each in choice[0]] == ["Wipe_careful_type_arm", "Wipe_careful_pre_free"]
    assert [each.get("ID") for each in choice[1:]] == ["Wipe_careful", "Wipe_plain"]


def test_fallback_lets_the_next_implementation_take_over() -> None:
    root = fromstring(bt.emit(compounded(fallback=True))["trees/Wipe.xml"])
    choice = next(root.iter("Fallback"))
    assert [each[-1].get("ID") for each in choice] == ["Wipe_careful", "Wipe_plain"]
    assert [each.tag for each in choice[1][:-1]] == [f"Wipe_pre_{each.label}" for each in WIPE.pre]


def test_no_file_for_skills_that_are_single_actions() -> None:
    assert bt.emit(library(PICK)) == {}


def test_names_of_nodes_stay_apart_from_each_other_and_from_built_in_ones() -> None:
    names = NodeIds()
    chosen = [names.of("Sequence"), names.of("a_b"), names.of("a", "b"), names.of("", "a", "b"), names.of("a_b")]
    assert chosen == ["Sequence_2", "a_b", "a_b_2", "a_b_3", "a_b"]
    assert (port_name("name"), port_name("name_"), port_name("arm"), port_name("ä"), port_name("_a")) == (
        "name_",
        "name__",
        "arm",
        "n_xe4_",
        "n_a",
    )


ODD = r"(name|ID|n|nn)_{0,3}a?|a__(\d|given)_?|(_|n_)?(xe4_|_xe4_|ä)"
some_names = st.from_regex(rf"[^\W\d]\w{{0,5}}|{ODD}", fullmatch=True)


@hypothesis_given(st.sets(some_names, min_size=2, max_size=30))
def test_no_two_names_have_one_port(written: set[str]) -> None:
    ports = {port_name(each) for each in written}
    assert len(ports) == len(written)
    assert all(re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", each) and each not in ("ID", "name") for each in ports)
    made = {entry_name("a", 1), given_port("a"), given_port("name")}
    assert not made & ports


TAKEN_OTHERWISE = (
    *("", "{a}", " {a} ", "=", "json:1", "JSON:[]", "12", "-12", "007", "1.5", "1.", ".5", "-1e5", "1E+5"),
    *("nan", "NaN", "-inf", "Infinity", "nan(1)", "9" * 30, "a\x01b", "\ufffe", "\ud800"),
)
TAKEN_AS_WRITTEN = (
    *("a", "+12", " 12", "12 ", "1;2", "0x1F", "1.5.2", "1e", "e5", "-", ".", "infinite", "true", "=a", "a{b}"),
    *("\t", "a\r", "<&>'", "ä", "é\u0301", "\U0001f600", "_", "@a", "json"),
)


def test_text_that_a_port_would_take_for_something_else_is_computed() -> None:
    assert [each for each in TAKEN_OTHERWISE if format_plain_value(Literal(each), "std::string") is not None] == []
    assert [format_plain_value(Literal(each), "std::string") for each in TAKEN_AS_WRITTEN] == list(TAKEN_AS_WRITTEN)


@pytest.mark.parametrize(
    ("value", "type_", "written"),
    [
        (12, "double", "12.0"),
        (12, "int", "12"),
        (12.0, "int", "12"),
        (-(2**31), "int", "-2147483648"),
        (2**31, "int", None),
        (0.1 + 0.2, "double", "0.30000000000000004"),
        (1e22, "double", "1e+22"),
        (123456789012345678, "double", "1.2345678901234568e+17"),
        (float("-inf"), "double", "-inf"),
        (True, "bool", "true"),
    ],
)
def test_a_number_is_written_as_the_type_of_its_port_is(value: float, type_: str, written: str | None) -> None:
    assert format_plain_value(Literal(value), type_) == written
