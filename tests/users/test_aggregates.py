"""Loops over individuals, counts and sums: what is proved, run and told of them, for books that are returned."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

LIBRARY = """\
use skiros
prefix lab: <http://example.org/lab#>

class    Book < Product
class    Cart < Location
relation holdsBook(Location, Book)
property weight(Book): Mass
property shelf(Book): Int

## Put `book` on `cart`.
skill Load {
    in    book: Book
    in    cart: Cart
    infer from: Location
    pre   there: from holdsBook book
    pre   room:  count(b: Book where cart holdsBook b) < 2
    post  cart holdsBook book
    post  not from holdsBook book
}

impl by_hand of Load { run python "skillc.primitives:StandIn" }

skill Empty { in bin: Location  post not bin holdsBook _  noplan }
impl by_hand of Empty { run python "skillc.primitives:StandIn" }

skill Add { in cart: Cart  in book: Book  post cart holdsBook book  noplan }
impl by_hand of Add { run python "skillc.primitives:StandIn" }

skill Need { in bin: Location  in book: Book  pre bin holdsBook book  noplan }
impl by_hand of Need { run python "skillc.primitives:StandIn" }

skill NeedRoom { in cart: Cart  pre count(b: Book where cart holdsBook b) < 2  noplan }
impl by_hand of NeedRoom { run python "skillc.primitives:StandIn" }
"""
ALL_LOADED = """\
    post forall b: Book (cart holdsBook b when bin holdsBook b)
    post forall b: Book (not bin holdsBook b when bin holdsBook b)"""
SCENE = """\
@prefix own: <https://w3id.org/skillc/library/own#> .
@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Bin a skiros:Location ; own:holdsBook lab:Atlas, lab:Novel .
lab:Cart a own:Cart .
lab:Atlas a own:Book ; own:weight 2.5 ; own:shelf 30 .
lab:Novel a own:Book ; own:weight 0.5 ; own:shelf 12 .
lab:Poems a own:Book ; own:shelf 12 .
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "lab.ttl").write_text(SCENE, "utf-8")
    (tmp_path / "skillc.toml").write_text('name = "own"\nedition = 2\nscene = "lab.ttl"\n', "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(folder: Path, text: str, *command: str) -> Result:
    (folder / "own.skill").write_text(LIBRARY + text, "utf-8")
    return CliRunner().invoke(skillc, [*command], catch_exceptions=False)


IN_BIN = "b: Book where lab:Bin holdsBook b"


@pytest.mark.parametrize(
    "lines",
    [
        f"do for {IN_BIN} by b.shelf {{ Load(book: b, cart: lab:Cart) }}  expect count({IN_BIN}) == 0",
        f'do for {IN_BIN} by b.shelf {{ fail "{{b}}" }}  expect failure "Novel"',
        f'do for {IN_BIN} {{ fail "{{b}}" }}  expect failure "Atlas"',
        'do for b: Book by b.weight { wait 1 s }  expect failure "lab:Poems has no own:weight"',
        f"do timeout 2.5 s {{ for {IN_BIN} {{ wait count(c: Book where c.weight <= b.weight) * 0.8 s }} }}",
        f"do check(sum({IN_BIN}, b.weight) == 3 kg and mean({IN_BIN}, b.weight) == 1.5 kg)",
        f"do check(max({IN_BIN}, b.weight) == 2.5 kg and min({IN_BIN}, b.shelf) == 12)",
        f'do wait min({IN_BIN} and b.shelf > 90, 1 s)  expect failure "`min` has no value: there is no own:Book of"',
        "do check(not sum(b: Book, b.weight) > 0 kg and sum(b: Book where lab:Cart holdsBook b, b.weight) == 0 kg)",
        f'do check(count({IN_BIN}) > 2)  expect failure "is 2; needed: > 2"',
        "do seq { Load(book: lab:Atlas, cart: lab:Cart) Load(book: lab:Novel, cart: lab:Cart) }",
        "start lab:Cart holdsBook lab:Poems  do try { for b: Book by b.shelf { Load(book: b, cart: lab:Cart) } }"
        "  expect lab:Bin holdsBook lab:Atlas and not lab:Bin holdsBook lab:Novel",
        "goal count(b: Book where lab:Cart holdsBook b) == 2  expect lab:Cart holdsBook lab:Atlas",
        "start lab:Bin holdsBook lab:Poems  goal count(b: Book where lab:Cart holdsBook b) >= 3  expect no plan",
    ],
)
def test_it_runs(folder: Path, lines: str) -> None:
    done = run(folder, f"test it {{ {lines} }}\n", "test", ".")
    assert done.exit_code == 0, done.output


OUTPUTS = """
skill Whole { in bin: Location  out n: Int  out m: Mass  noplan }
impl own of Whole { BODY }
"""


@pytest.mark.parametrize(
    ("body", "found"),
    [
        (f"out n = count({IN_BIN})  out m = k * 1 kg  let k = 2  do wait 1 s", []),
        ("out n = 2  do wait 1 s", ["out-never-assigned"]),
        ("out n = 2 m  out m = 1 kg  do wait 1 s", ["wrong-type"]),
        ("out n = 2  out n = 3  out m = 1 kg  do wait 1 s", ["duplicate-member"]),
        ("out bin = 2  out n = 2  out m = 1 kg  do wait 1 s", ["unknown-parameter"]),
        ("out n = k  out m = 1 kg  do wait 1 s", ["unknown-parameter"]),
        ('out n = 2  run python "skillc.primitives:StandIn"', ["misplaced-output"]),
        ("out n = k  out m = 1 kg  do try { seq { check(bin holdsBook _) Size(bin) -> k } }", ["out-unassigned"]),
        ("out n = k + 1  out m = 1 kg  do Size(bin) -> k", []),
    ],
)
def test_outputs_are_checked(folder: Path, body: str, found: list[str]) -> None:
    text = "skill Size { in bin: Location  out n: Int  noplan }\n"
    text += "impl own of Size { out n = count(b: Book where bin holdsBook b)  do wait 1 s }\n"
    told = json.loads(run(folder, text + OUTPUTS.replace("BODY", body), "check", "--json").stdout)
    assert sorted({each["name"] for each in told if each["severity"] == "error"}) == found, told


def test_outputs_are_computed_at_the_end(folder: Path) -> None:
    text = "skill Empty2 { in bin: Location  in cart: Cart  out left: Int  out lightest: Mass  noplan\n"
    text += f"{ALL_LOADED} }}\n"
    text += "impl own of Empty2 { out left = count(b: Book where bin holdsBook b)\n"
    text += "    out lightest = min(b: Book where bin holdsBook b, b.weight)\n"
    text += "    do for b: Book where bin holdsBook b by b.shelf { Load(book: b, cart, from: bin) } }\n"
    text += f"skill Left {{ in bin: Location  in cart: Cart  out left: Int  noplan\n{ALL_LOADED} }}\n"
    text += "impl own of Left { out left = count(b: Book where bin holdsBook b) + 1\n"
    text += "    do for b: Book where bin holdsBook b by b.shelf { Load(book: b, cart, from: bin) } }\n"
    text += (
        'test one { do seq { Left(bin: lab:Bin, cart: lab:Cart) -> n  fail "{n} left" }  expect failure "1 left" }\n'
    )
    text += 'test none { do Empty2(bin: lab:Bin, cart: lab:Cart)  expect failure "`min` has no value: there is no" }\n'
    done = run(folder, text, "test", ".")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("body", "unproved"),
    [
        ("for b: Book where bin holdsBook b { Need(bin, book: b) }", 0),
        ("for b: Book { Need(bin, book: b) }", 1),
        (f"for b: Book where bin holdsBook b {{ Load(book: b, cart, from: bin) }}\n{ALL_LOADED}", 1),
        ("for b: Book where bin holdsBook b { seq { Need(bin, book: b) Empty(bin) } }", 1),
        ("for b: Book where bin holdsBook b { seq { Need(bin, book: b) Add(cart, book: b) } }", 0),
        ("if count(b: Book where cart holdsBook b) < 1 { NeedRoom(cart) }", 0),
        ("if count(b: Book where cart holdsBook b) < 3 { NeedRoom(cart) }", 1),
        ("if 2 > count(b: Book where cart holdsBook b) { NeedRoom(cart) }", 0),
        ("if count(c: Book where cart holdsBook c) < 2 { seq { wait 1 s NeedRoom(cart) } }", 0),
        (
            "seq { check(count(c: Book where cart holdsBook c) < 2) Add(cart, book) NeedRoom(cart) }\n"
            "    post cart holdsBook book",
            1,
        ),
        ("for y: Book { if count(c: Book where cart holdsBook c) < 2 { Empty(bin) NeedRoom(cart) } }", 0),
        ("if count(b: Book where bin holdsBook b) == 0 { Need(bin, book) }", 1),
        ("if count(b: Book where bin holdsBook b) == 0 { if bin holdsBook book { Need(bin, book) } }", 0),
        ("while cart holdsBook book max n { NeedRoom(cart) }", 1),
    ],
)
def test_what_is_proved(folder: Path, body: str, unproved: int) -> None:
    text = "skill Whole { in bin: Location  in cart: Cart  in book: Book  opt n: Int = 2  range 1 .. 3  noplan }\n"
    body, _, posts = body.partition("\n")
    text += f"impl own of Whole {{\n{posts}\n    do {body} }}\n"
    told = json.loads(run(folder, text, "check", "--json").stdout)
    assert [each["name"] for each in told].count("child-precondition") == unproved, told
