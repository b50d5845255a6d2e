"""What a task names is looked for in its scene, where the scene is known."""

import pytest
from shipped import library, shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

LAB = "http://example.org/lab#"
CLASSES = {
    "Board-1": ["wiping:Whiteboard"],
    "Arm-1": ["skillc:Ur5e", "rparts:ArmDevice"],
    "Felt-1": ["wiping:Eraser", "skiros:Product"],
}
SCENE = {LAB + name: [vocabulary().expand(cls) for cls in classes] for name, classes in CLASSES.items()}
HEADER = 'use skiros, wiping, skillc\nprefix lab: <http://example.org/lab#>\nimport "wipe.skill"\n'


def told(member: str, scenes: dict[str, dict[str, list[str]]]) -> list[Diagnostic]:
    """Compile a task called `clean` with a goal or a body on the sixth line."""
    own = Source("own.skill", f'{HEADER}task clean {{\n    scene "here.ttl"\n    {member}\n}}\n')
    outcome = compile([own], vocabulary(), {**shelf(), **{s.path: s for s in library("wiping")}}, "own", scenes)
    return [d for d in outcome.diagnostics if d.severity == "error"]


WRONG = [
    ("goal lab:Bord-1.isClean == true", "unknown-individual", 10, "did you mean `lab:Board-1`"),
    ("do Wipe(surface: lab:Bord-1)", "unknown-individual", 22, "did you mean `lab:Board-1`"),
    ("do Wipe(surface: lab:Felt-1)", "wrong-type", 22, "WipeableSurface"),
    ("goal lab:Arm-1.isClean == true", "property-domain", 10, "WipeableSurface"),
    ("goal lab:Board-1 contain lab:Felt-1", "relation-domain", 10, "Whiteboard"),
]


@pytest.mark.parametrize(("member", "name", "column", "words"), WRONG)
def test_a_wrong_individual_is_told_where_it_is_written(member: str, name: str, column: int, words: str) -> None:
    problems = told(member, {"clean": SCENE})
    assert [(d.name, d.span.path, d.span.line, d.span.column) for d in problems] == [(name, "own.skill", 6, column)]
    assert words in f"{problems[0].message} {problems[0].help}"


@pytest.mark.parametrize("member", ["goal lab:Board-1.isClean == true", "do Wipe(surface: lab:Board-1)"])
def test_what_is_there_may_be_named(member: str) -> None:
    assert told(member, {"clean": SCENE}) == []


@pytest.mark.parametrize("scenes", [{}, {"another": SCENE}])
def test_without_a_scene_any_individual_may_be_named(scenes: dict[str, dict[str, list[str]]]) -> None:
    assert told("goal lab:Bord-1.isClean == true", scenes) == []
