"""Goals in `.skill` and PDDL text mean the same; calls and goals are checked against library and scene."""

import re

import msgspec
import pytest
from shipped import library, shelf, vocabulary

from skillc_compiler.goals.parsing import home_of, parse_call, parse_goal
from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.position import Position
from skillc_dsl.source import Source
from skillc_model.conditions import And, Condition, Exists, Forall, Holds, Individual, Literal
from skillc_model.format_condition import format_condition

LAB = "http://example.org/lab#"


def scene() -> dict[str, tuple[str, ...]]:
    names = {"Board": "wiping:Whiteboard", "Arm": "skillc:Ur5e", "Hand": "skillc:WsgGripper", "Felt": "wiping:Eraser"}
    names |= {"Part-1": "skiros:Product", "y": "skiros:Product"}
    return {LAB + name: (vocabulary().expand(cls),) for name, cls in names.items()}


def goal(text: str) -> Outcome[Condition | None]:
    return parse_goal(text, vocabulary(), scene(), {"lab": LAB})


SAME = [
    ("lab:Board.isClean == true", "(wiping:isClean lab:Board)"),
    ("lab:Hand contain lab:Felt", "(skiros:contain lab:Hand lab:Felt)"),
    ("(lab:Hand contain lab:Felt)", "(contain lab:Hand lab:Felt)"),
    (
        "not lab:Board.isClean == true or lab:Hand contain lab:Felt",
        "(or (not (wiping:isClean lab:Board)) (skiros:contain lab:Hand lab:Felt))",
    ),
    (
        "exists x: Eraser (forall y: wiping:Whiteboard (x == x and y.isClean == true))",
        "(exists (?x - wiping:Eraser) (forall (?y - Whiteboard) (and (= ?x ?x) (wiping:isClean ?y)))) ; comment",
    ),
    ("lab:Board.isClean == true implies lab:Felt is Tool", "(imply (isClean lab:Board) (skillc:Tool lab:Felt))"),
]


@pytest.mark.parametrize(("text", "pddl"), SAME)
def test_both_texts_mean_the_same(text: str, pddl: str) -> None:
    one, other = goal(text), goal(pddl)
    assert one.value is not None and one.value == other.value
    assert one.ok and other.ok


WRITTEN = [
    *(text for text, _ in SAME),
    "lab:Hand contain _ and (lab:Hand contain lab:Felt or not (lab:Board is Tool or lab:Felt is Tool))",
    "forall x: GripperSheet ((x.maxOpening + x.maxOpening) * 2 < x.maxOpening * 5 / 2)",
    "exists x: WipeableSurface (not x == lab:Board and x has isClean)",
]


@pytest.mark.parametrize("text", WRITTEN)
def test_what_is_written_of_a_condition_means_the_same(text: str) -> None:
    known = msgspec.structs.replace(vocabulary(), prefixes={**vocabulary().prefixes, "lab": LAB})
    meant = goal(text).value
    assert meant is not None and goal(format_condition(meant, known)).value == meant


TINY = "lab:Felt.Weight > 0.00000001 kg"


def as_json(condition: Condition) -> str:
    return msgspec.json.encode(condition).decode()


@pytest.mark.parametrize(
    "text",
    [*WRITTEN, "lab:Felt.Weight > 1 kg and lab:Felt.Weight != 0.123456789 kg and lab:Felt.Weight > 0.00000001 kg"],
)
def test_a_goal_in_json_is_a_condition_of_a_compiled_library(text: str) -> None:
    meant = goal(text).value
    assert meant is not None and goal(as_json(meant)).value == meant
    known = msgspec.structs.replace(vocabulary(), prefixes={**vocabulary().prefixes, "lab": LAB})
    short = re.sub(r'"(http[^"]+)"', lambda found: f'"{known.short(found[1])}"', as_json(meant))
    assert short != as_json(meant) and goal(short).value == meant


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "this is no condition in JSON: Input data was truncated"),
        ('{"type": "hold"}', "Invalid value 'hold' - at `$.type`"),
        ('{"type": "holds", "subject": {"type": "anything"}}', "missing required field `relation`"),
        (
            '{"type": "is", "subject": {"type": "individual", "iri": "lab:Feld"}, "cls": "skillc:Tool"}',
            "there is no `lab:Feld` in the scene",
        ),
        (
            '{"type": "has", "subject": {"type": "individual", "iri": "lab:Felt"}, "property": "skiros:Wait"}',
            "there is no property `skiros:Wait`",
        ),
        ('{"type": "not", "body": ' * 1500 + "1" + "}" * 1500, "the goal is nested too deeply"),
        ("{" + " " * 60_000 + "}", "the goal has 60002 characters, and 50000 at most are read"),
        ('{"type": "not", "body": ' * 200 + "1" + "}" * 200, "this is no condition in JSON"),
    ],
)
def test_a_goal_in_json_that_is_wrong_says_what(text: str, said: str) -> None:
    refused = goal(text)
    assert refused.value is None and said in refused.diagnostics[0].message, refused.diagnostics


def test_the_kinds_of_goals_are_kept() -> None:
    assert isinstance(goal("(and (contain lab:Hand lab:Felt) (isClean lab:Board))").value, And)
    assert isinstance(goal("(exists (?x) (contain lab:Hand ?x))").value, Exists)
    assert isinstance(goal("(forall (?x ?y - Eraser) (= ?x ?y))").value, Forall)


BRACKETED = [
    ("(lab:Board.isClean == true)", "lab:Board.isClean == true"),
    ("(not (lab:Board.isClean == true))", "not lab:Board.isClean == true"),
    ("(exists x: Eraser (lab:Hand contain x))", "exists x: Eraser (lab:Hand contain x)"),
    ("(not (contain lab:Hand lab:Felt))", "not lab:Hand contain lab:Felt"),
]


@pytest.mark.parametrize(("text", "plain"), BRACKETED)
def test_a_goal_in_parentheses_need_not_be_pddl(text: str, plain: str) -> None:
    one, other = goal(text), goal(plain)
    assert one.value is not None and one.value == other.value


WRONG = [
    ("lab:Bord.isClean == true", "unknown-individual", 1, "did you mean `lab:Board`"),
    ("(isClean lab:Bord)", "unknown-individual", 10, "did you mean `lab:Board`"),
    ("(skiros:contains lab:Hand lab:Felt)", "unknown-relation", 2, "did you mean `skiros:contain`"),
    ("lab:Hand contains lab:Felt", "unknown-relation", 10, "did you mean `contain`"),
    ("(isClean lab:Hand)", "property-domain", 10, "WipeableSurface"),
    ("lab:Felt contain lab:Hand", "relation-domain", 1, "Eraser"),
    ("lba:Board.isClean == true", "unknown-prefix", 1, "did you mean `lab`"),
    ("Board.isClean == true", "missing-prefix", 1, "write `lab:Board`"),
    ("lab:Hand contain Part-1", "missing-prefix", 18, "write `lab:Part-1`"),
    ("Part-2.isClean == true", "missing-prefix", 1, "write `lab:Part-1`"),
    ("(isClean Board)", "missing-prefix", 10, "write `lab:Board`"),
    ("Bench.isClean == true", "unknown-parameter", 1, "with its prefix"),
    ("(isClean lab:Board", "syntax", 1, "`)` is missing"),
    ("(isClean lab:Board))", "syntax", 20, "closes nothing"),
    ("lab:Board.isClean == true lab:Board", "syntax", 27, "a goal is a condition"),
    ("(and lab:Board)", "syntax", 6, "stands alone"),
    ("(contain lab:Hand)", "unknown-property", 2, "relation"),
    ("(exists lab:Hand (isClean lab:Board))", "syntax", 1, "not a goal"),
    ("(> (Weight lab:Felt) 1)", "syntax", 1, "numbers with their units: `lab:Felt.Weight > 1`"),
    ("(and (= (isClean lab:Board) true))", "syntax", 6, "`lab:Board.isClean == true`"),
    ("(exists (?x - Product) (<= 1 (Weight ?x)))", "syntax", 24, "`1 <= x.Weight`"),
    ("lab:Board.isClean ==", "syntax", 19, "missing"),
    ("", "syntax", 1, "the goal is empty"),
    ("lab:Hand contain lab:Felt } task x { goal lab:Board.isClean == true", "syntax", 1, "not one goal"),
    ("lab:Hand contain lab:Felt do Wipe(surface: lab:Board)", "syntax", 1, "not one goal"),
]


@pytest.mark.parametrize(("text", "name", "column", "words"), WRONG)
def test_a_wrong_goal_is_explained(text: str, name: str, column: int, words: str) -> None:
    outcome = goal(text)
    assert outcome.value is None
    problem = outcome.diagnostics[0]
    assert (problem.name, problem.span.path, problem.span.line) == (name, "goal", 1)
    assert problem.span.column == column
    assert words in f"{problem.message} {problem.help}"
    assert problem.fix is None or (problem.fix.span.line, problem.fix.span.column) == (1, column)
    assert not any("member of a task" in d.message or "`}`" in d.message for d in outcome.diagnostics)


def test_calls() -> None:
    wiping = compile(library("wiping"), vocabulary(), shelf(), "wiping").value
    outcome = parse_call("Wipe(surface: lab:Board, speed: 5 cm/s)", wiping, scene(), {"lab": LAB})
    assert outcome.value is not None
    assert outcome.value.arguments == {"surface": Individual(LAB + "Board"), "speed": Literal(0.05)}
    assert outcome.value.source == Position("call", 1, 1)
    assert parse_call("# the board\nWipe(surface: lab:Board)", wiping, scene(), {"lab": LAB}).ok


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "called"),
    [
        ("Wipe(lab:Board)", "Wipe(surface: lab:Board)"),
        ("Wipe(surface: lab:Board)", "Wipe(surface: lab:Board)"),
        ("do Wipe(surface = lab:Board)", "Wipe(surface: lab:Board)"),
        ("(wipe lab:Board)", "Wipe(surface: lab:Board)"),
        ("# the board\nWipe(lab:Board)", "Wipe(surface: lab:Board)"),
        ("Wipe", "Wipe(surface: ..)"),
    ],
)
def test_a_skill_as_a_goal_is_told_what_it_makes_true(text: str, called: str) -> None:
    wiping = compile(library("wiping"), vocabulary(), shelf(), "wiping").value
    outcome = parse_goal(text, vocabulary(), scene(), {"lab": LAB}, home_of(wiping), wiping.skills)
    [problem] = outcome.diagnostics
    made = "lab:Board.isClean == true" if "lab:Board" in text else "surface.isClean == true"
    assert problem.name == "not-a-condition" and f"`{made}`" in problem.help and f"`{called}`" in problem.help
    ran = parse_call(called, wiping, scene(), {"lab": LAB})
    assert ran.ok is (".." not in called)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("lab:Board.isClean == true", "syntax"),
        ("Wipe lab:Board", "syntax"),
        ("Wipe(lab:Board)", "unknown-argument"),
        ("Wip(surface: lab:Board)", "unknown-skill"),
        ("Wipe(surfac: lab:Board)", "unknown-argument"),
        ("Wipe()", "missing-argument"),
        ("Wipe(surface: lab:Felt)", "wrong-type"),
        ("Wipe(surface: lab:Board, speed: 3 N)", "wrong-dimension"),
        ("Wipe(surface: lab:Board, speed: 3 m/s)", "out-of-range"),
        ("Wipe[lanes](surface: lab:Board)", "unknown-implementation"),
        ("seq { }", "syntax"),
        ("Wipe(", "syntax"),
        ("", "syntax"),
        ("Wipe(surface: Board)", "missing-prefix"),
    ],
)
def test_a_wrong_call_is_explained(text: str, name: str) -> None:
    wiping = compile(library("wiping"), vocabulary(), shelf(), "wiping").value
    outcome = parse_call(text, wiping, scene(), {"lab": LAB})
    assert outcome.value is None
    assert [(d.name, d.span.line) for d in outcome.diagnostics] == [(name, 1)]


OWN = """use skiros
class Crate < Location
relation on(Crate, Crate)
"""


def test_a_bare_name_means_what_it_means_in_the_library() -> None:
    stacks = compile([Source("stacks.skill", OWN)], vocabulary(), shelf(), "stacks").value
    crates = {LAB + name: (stacks.namespace + "Crate",) for name in "ab"}
    here, anywhere = (
        parse_goal("lab:a on lab:b", stacks.vocabulary, crates, {"lab": LAB}, home) for home in (home_of(stacks), ())
    )
    assert isinstance(here.value, Holds) and here.value.relation == stacks.namespace + "on"
    assert [each.name for each in anywhere.diagnostics] == ["ambiguous-name"]


TRIVIAL = ["not lab:Hand contain lab:Hand", "not 1 == 2", "lab:Hand contain lab:Hand implies lab:Board.isClean == true"]


@pytest.mark.parametrize("text", TRIVIAL)
def test_what_shall_not_hold_and_never_does_is_no_error(text: str) -> None:
    asked = goal(text)
    assert asked.value is not None and [each.name for each in asked.diagnostics] == ["always-true"]


def test_a_number_has_the_unit_of_the_property_that_it_is_compared_with() -> None:
    written = ("lab:Board.normalForce >= 7.25 N", "lab:Board.cleanThreshold < 0.5")
    read = [goal(text).value for text in written]
    told = [format_condition(each, vocabulary()) for each in read if each is not None]
    assert [each.replace(LAB, "lab:") for each in told] == list(written)
