"""Names, values and types that a format of trees may misread, in BehaviorTree.CPP 4.8.2 and by the rules of 4.10."""

from __future__ import annotations

from pathlib import Path

import pytest

from emit.tree_rules import Reader
from peers.comparing import differences
from skillc_compiler.emit import bt
from skillc_compiler.emit import bt as bt_depth
from skillc_compiler.emit.bt.names import BUILT_IN
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.load import load

HEAD = """\
prefix lab: <http://example.org/lab#>
class Item
property level(Item): Number
function items() -> [Item] = python "x:items"
function levels() -> [Number] = python "x:levels"
skill Whole { in a: Item  out n: Int  noplan }
impl one of Whole { run python "x:C" }
skill Part { in a: Item  out n: Number  noplan }
impl one of Part { run python "x:C" }
skill Eat { in a: Item  in n: Number  opt t: Text = "7"  opt i: Int = 3  noplan }
impl one of Eat { run python "x:C" }
skill Kept { in a: Item  in n: Number  opt t: Text = "7"  opt i: Int = 3  hold a.level < 3  noplan }
impl one of Kept { run python "x:C" }
"""
BODIES = {
    "whole numbers for ports of Number": "Kept(a, n: 12) Kept(a, n: k) Eat(a, n: k) Eat(a, n: 0)",
    "numbers that are no int": "Kept(a, n: 1e99, i: 2147483648) Eat(a, n: 9007199254740991, i: -2147483648)",
    "text that looks like an int": 'Kept(a, n: 1, t: "12") Eat(a, n: 1, t: "-12")',
    "text that looks like a double": 'Kept(a, n: 1, t: "-1e5") Kept(a, n: 1, t: "nan") Eat(a, n: 1, t: "1.5")',
    "text that looks like an entry": 'Kept(a, n: 1, t: "{a}") Kept(a, n: 1, t: " {a} ") Eat(a, n: 1, t: "=")',
    "no text": 'Kept(a, n: 1, t: "") Eat(a, n: 1, t: "")',
    "text with marks": 'Kept(a, n: 1, t: "<\'&>;:\\") Kept(a, n: 1, t: " x\t") Eat(a, n: 1, t: "json:[1]")',
    "text that XML cannot hold": 'Kept(a, n: 1, t: "\x01") Eat(a, n: 1, t: "\ufffe")',
    "an Int for a variable of Number": "Part(a) -> n  Whole(a) -> n  Kept(a, n: n)",
    "one name for two types in branches": (
        "sel { seq { Whole(a) -> m Eat(a, n: m, i: m) } seq { Part(a) -> m Kept(a, n: m) } }"
    ),
    "one name for one type in branches": "if a.level < 2 { Part(a) -> m } else { Part(a) -> m } Kept(a, n: m)",
    "one name for items of two types": "for u in items() { Eat(a: u, n: 1) } for u in levels() { Kept(a, n: u) }",
    "rounds and times beyond the ports": "repeat 1000000 { retry 1000000 { timeout 3e7 s { wait 3e7 s } } }",
}


def trees(text: str) -> dict[str, str]:
    """Compile a library and return its trees."""
    outcome = compile([Source("own.skill", text)], load([]).value, {}, "own")
    assert [each for each in outcome.diagnostics if each.severity == "error"] == []
    return bt.emit(outcome.value)


def check(text: str, folder: Path) -> dict[str, str]:
    """Hold the trees of a library against the rules and the library."""
    found = trees(text)
    for number, tree in enumerate(found.values()):
        path = folder / f"{number}.xml"
        path.write_text(tree, "utf-8")
        assert list(differences(path)) == []
    return found


def compound(body: str) -> str:
    """Write a compound skill with defaults that no port can have."""
    head = 'skill Top { in a: Item  in k: Int  opt z: Text = "12"  opt y: Int = 99999999999  noplan }\n'
    return f"{head}impl own of Top {{ do seq {{ {body} Eat(a, n: 1, t: z, i: y) }} }}\n"


@pytest.mark.parametrize("words", BODIES)
def test_values_keep_their_types(words: str, tmp_path: Path) -> None:
    assert list(check(HEAD + compound(BODIES[words]), tmp_path)) == ["trees/Top.xml"]


def test_a_default_that_no_port_can_have_is_computed_where_a_skill_runs_by_itself() -> None:
    reader = Reader.of(trees(HEAD + compound(""))["trees/Top.xml"])
    (call,) = reader.trees["Top_main"].iter("SubTree")
    made = {node.get("value") for node in reader.trees["Top_main"].iter() if "evaluate" in node.tag}
    assert {call.get("z"), call.get("y")} == made and len(made) == 2


@pytest.mark.parametrize("kind", ["primitive", "compound"])
def test_a_skill_may_have_a_name_that_the_library_registers_itself(kind: str, tmp_path: Path) -> None:
    names = sorted(BUILT_IN - {"root"})
    body = "do Whole(a) -> n" if kind == "compound" else 'run python "x:C"'
    skills = [f"skill {each} {{ in a: Item  noplan }}\nimpl one of {each} {{ {body} }}\n" for each in names]
    found = check(HEAD + "".join(skills) + compound(" ".join(f"{each}(a)" for each in names)), tmp_path)
    called = Reader.of(found["trees/Top.xml"]).names().values()
    assert {(each,) for each in names} <= set(called)


def test_a_value_may_be_computed_from_what_is_called_value(tmp_path: Path) -> None:
    skill = "skill Mix { in a: Item  in value: Number  in value_: Number  in value__: Int  noplan }\n"
    body = (
        "Eat(a, n: value + value_ + 1) Eat(a, n: value__) Part(a) -> value___ Whole(a) -> value___ Eat(a, n: value___)"
    )
    found = check(f"{HEAD}{skill}impl own of Mix {{ do seq {{ {body} }} }}\n", tmp_path)
    assert 'value__="{n__1}"' in found["trees/Mix.xml"]


def test_a_task_and_a_skill_do_not_write_one_file(tmp_path: Path) -> None:
    skill = "skill task_x { in a: Item  noplan }\nimpl own of task_x { do Whole(a) -> n }\n"
    found = check(HEAD + skill + "task x { do task_x(a: lab:A-1) }\n", tmp_path)
    assert sorted(found) == ["trees/task_x.xml", "trees/task_x_2.xml"]


def test_what_is_nested_too_deep_is_cut_and_runs_alike(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bt_depth, "DEEPEST", 5)
    loops = "try { while a.level < 3 max 3 { once { "
    body = "Part(a) -> n " + 4 * loops + "Eat(a, n: n) Part(a) -> n" + 4 * " } } }" + " Eat(a, n: n)"
    found = check(HEAD + compound(body), tmp_path)
    assert found["trees/Top.xml"].count("_autoremap") > 3


def test_the_deepest_text_is_not_too_deep_for_the_library(tmp_path: Path) -> None:
    loops = 60 * "while a.level < 3 max 3 { "
    text = trees(HEAD + compound(loops + "Eat(a, n: 1)" + 60 * " }"))["trees/Top.xml"]
    assert text.count("_autoremap") == 1
