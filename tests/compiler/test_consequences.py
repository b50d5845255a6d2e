"""What is said of a program depends on what is erroneous in it, not on the names or the words of diagnostics."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest
from shipped import shelf, vocabulary

import skillc_compiler
import skillc_dsl
from skillc_compiler.checks import load_checks
from skillc_compiler.manual import page_names
from skillc_compiler.pipeline import compile
from skillc_compiler.program.marks import Need
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.edits import apply_fixes
from skillc_dsl.source import Source

PACKAGES = [Path(next(iter(package.__path__))) for package in (skillc_compiler, skillc_dsl)]
READERS = {"startswith", "endswith", "match", "search", "fullmatch", "findall", "split", "partition", "find", "index"}


HEADER = "use skiros, rparts, skillc\n"
RUN = 'impl one of {} {{\n run python "skillc.primitives:StandIn"\n}}\n'


def skill(name: str) -> str:
    """Return a skill with an arm."""
    return f"skill {name} {{\n in arm: ArmDevice\n noplan\n}}\n"


MOVES = "use rparts\n" + skill("TakePosture") + RUN.format("TakePosture")


def modules() -> Iterator[tuple[Path, ast.Module]]:
    """Yield the modules of the compiler and of the parser."""
    for package in PACKAGES:
        for path in sorted(package.rglob("*.py")):
            yield path, ast.parse(path.read_text())


def problems(text: str) -> list[Diagnostic]:
    """Compile a text; return its diagnostics."""
    return list(compile([Source("m.skill", text)], vocabulary(), shelf(), "own").diagnostics)


WEIGHING = """\
skill Weigh {
    in  arm:   ArmDevice
    opt limit: Mass
    out mass:  Mass
    uses arm
    pre  arm.deviceState == Idle
    pre  given limit implies limit > 1 g
    noplan
}
impl at_once of Weigh { run python "skillc.primitives:StandIn" }
impl twice of Weigh {
    prefer 1
    do seq { Weigh[at_once](arm) -> mass  Weigh[at_once](arm, limit: 2 g) -> mass }
}
skill Sort { in arm: ArmDevice  in least: Mass  in most: Mass  noplan }
impl by_mass of Sort {
    do seq {
        Weigh(arm) -> one
        check(one > least and one < most)
        Weigh(arm, limit: most) -> other
        check(other > least)
    }
}
skill SortAll { in arm: ArmDevice  in most: Mass  noplan }
impl once of SortAll { do Sort(arm, least: 1 g, most) }
impl again of SortAll { prefer 1  do seq { Sort(arm, least: 2 g, most)  Sort(arm, least: 3 g, most) } }
"""
"""Skills whose parameters are read, passed, left out and taken at several places."""


def test_parameters_that_are_declared_rightly_are_no_problem() -> None:
    assert [each.name for each in problems(HEADER + WEIGHING) if each.severity == "error"] == []


@pytest.mark.parametrize(
    ("declared", "wrong", "found"),
    [
        ("in  arm:   ArmDevice", "out arm:   ArmDevice", "not-a-device"),
        ("in  arm:   ArmDevice", "opt arm:   ArmDevice", "unset-optional"),
        ("opt limit: Mass", "in  limit: Mass", "missing-argument"),
        ("opt limit: Mass", "out limit: Mass", "out-unassigned"),
        ("out mass:  Mass", "in  mass:  Mass", "no-output"),
        ("out mass:  Mass", "opt mass:  Mass", "no-output"),
        ("in least: Mass", "out least: Mass", "unknown-argument"),
        ("in least: Mass", "opt least: Mass", "unset-optional"),
    ],
)
def test_a_parameter_with_the_wrong_direction_is_one_error_that_shows_it(declared: str, wrong: str, found: str) -> None:
    text = HEADER + WEIGHING.replace(declared, wrong)
    error, *others = [each for each in problems(text) if each.severity == "error"]
    assert (error.name, others) == (found, [])
    shown = {label.span.line for label in error.labels if label.is_cause}
    assert shown == {text[: text.index(wrong)].count("\n") + 1}


def test_a_direction_that_something_relies_on_is_not_the_cause() -> None:
    text = WEIGHING.replace("uses arm", "uses arm\n    pre limit < 1 kg\n    hold limit > 2 g")
    errors = [each for each in problems(HEADER + text) if each.severity == "error"]
    assert [each.name for each in errors] == ["unset-optional", "unset-optional"]


CLEARING = """\
skill Clear { in surface: WipeableSurface  post surface.isClean == true }
impl at_once of Clear { run python "skillc.primitives:StandIn" }
skill Note { in surface: WipeableSurface  pre surface.isClean == false  noplan }
impl at_once of Note { run python "skillc.primitives:StandIn" }
property isDusty(WipeableSurface): Bool
skill Dust { in surface: WipeableSurface  post surface.isDusty == true }
impl at_once of Dust { run python "skillc.primitives:StandIn" }
"""


def test_two_skills_that_do_not_declare_one_effect_are_two_errors() -> None:
    text = HEADER.replace("rparts", "rparts, wiping") + CLEARING
    text += "".join(
        f"skill {name} {{ in surface: WipeableSurface  noplan }}\nimpl once of {name} {{ do Clear(surface) }}\n"
        for name in ("Tidy", "Reset")
    )
    errors = [each.name for each in problems(text) if each.severity == "error"]
    assert errors == ["undeclared-effect", "undeclared-effect"]


@pytest.mark.parametrize(
    ("steps", "found"),
    [
        ("Clear(surface)  Note(surface)  Dust(surface)", ["child-precondition"]),
        ("Clear(surface)  try { Note(surface) }  Dust(surface)", ["child-precondition", "undeclared-effect"]),
    ],
)
def test_only_after_a_call_that_nothing_catches_nothing_more_is_found(steps: str, found: list[str]) -> None:
    text = HEADER.replace("rparts", "rparts, wiping") + CLEARING
    text += "skill Go { in surface: WipeableSurface  post surface.isClean == true  noplan }\n"
    text += "impl once of Go { do seq {\n  " + "\n  ".join(steps.split("  ")) + "\n} }\n"
    assert [each.name for each in problems(text) if each.severity == "error"] == found


def test_a_skill_that_is_declared_as_something_else_is_one_error() -> None:
    text = HEADER + WEIGHING.replace("skill Weigh", "task Weigh")
    assert [each.name for each in problems(text) if each.severity == "error"] == ["syntax"]


def test_only_a_check_itself_lists_names_of_diagnostics() -> None:
    lists = []
    for path, tree in modules():
        own = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Assign) and _is_names(node)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Set | ast.List | ast.Tuple | ast.Dict) and id(node) not in own:
                parts = [*node.keys, *node.values] if isinstance(node, ast.Dict) else node.elts
                named = [each.value for each in parts if isinstance(each, ast.Constant) and each.value in page_names()]
                lists += [f"{path}:{node.lineno}: {', '.join(named)}"] if len(named) > 1 else []
    assert lists == []
    assert all(one.NAMES and isinstance(one.NEEDS, Need) for one in load_checks())


def _is_names(node: ast.Assign) -> bool:
    return [target.id for target in node.targets if isinstance(target, ast.Name)] == ["NAMES"]


def test_no_diagnostic_is_read_as_text() -> None:
    read = []
    for path, tree in modules():
        for node in ast.walk(tree):
            match node:
                case ast.Call(func=ast.Attribute(value=ast.Attribute(attr="help" | "message"), attr=reader)):
                    read += [f"{path}:{node.lineno}"] if reader in READERS else []
                case ast.Call(func=ast.Attribute(attr=reader), args=[ast.Attribute(attr="help" | "message"), *_]):
                    read += [f"{path}:{node.lineno}"] if reader in READERS else []
                case ast.Compare(comparators=[ast.Attribute(attr="help" | "message" | "reason")]):
                    read.append(f"{path}:{node.lineno}")
                case _:
                    pass
    assert read == []


def test_a_misspelt_skill_with_eight_callers_is_one_error_at_its_declaration() -> None:
    called = (f"{skill(f'Go{number}')}impl one of Go{number} {{\n do Mov(arm)\n}}\n" for number in range(8))
    (found,) = problems(HEADER + skill("Movv") + "".join(called))
    assert (found.name, found.span.line, len(found.labels)) == ("unknown-skill", 2, 8)
    assert found.fix is not None
    assert found.fix.text == "Mov"


def test_a_forgotten_import_is_one_error_with_the_line_to_add() -> None:
    calls = " do seq {\n  TakePosture(arm)\n  TakePosture(arm)\n }\n"
    own, other = Source("m.skill", f"use rparts\n{skill('Go')}impl one of Go {{\n{calls}}}\n"), Source("o.skill", MOVES)
    (found,) = compile([own, other], vocabulary(), {}, "own").diagnostics
    assert found.name == "unknown-skill"
    assert found.fix is not None
    mended = Source("m.skill", apply_fixes(own.text, [found.fix]))
    assert compile([mended, other], vocabulary(), {}, "own").diagnostics == ()


def test_a_parameter_of_the_wrong_type_is_one_error_however_often_it_is_used() -> None:
    used = " pre arm hasA gripper\n pre gripper.deviceState == Idle\n pre not gripper contain _\n"
    text = f"{HEADER}skill Hold {{\n in arm: ArmDevice\n in gripper: Bool\n{used} noplan\n}}\n{RUN.format('Hold')}"
    (found,) = problems(text)
    assert any(label.span.line == 4 for label in found.labels)


def test_a_line_that_is_typed_twice_is_one_error() -> None:
    text = f"{HEADER}skill Go {{\n{skill('Go')}{RUN.format('Go')}"
    assert [d.name for d in problems(text)] == ["unclosed-brace"]


def test_what_a_syntax_error_removed_is_not_unknown() -> None:
    text = (
        "use skiros\n"
        'function height arm: ArmDevice) -> Length = python "skillc_runtime.world.places:across"\n'
        "skill Go {\n in arm: ArmDevice\n pre height(arm) > 1 m\n noplan\n}\n"
        'impl one of Go {\n run python "skillc.primitives:StandIn"\n}\n'
    )
    assert [(d.name, d.span.line) for d in problems(text)] == [("syntax", 2)]


def test_a_declaration_that_lost_its_name_had_one() -> None:
    nameless = HEADER + skill("").replace("skill  {", "skill {") + RUN.format("Go")
    assert [(d.name, d.span.line) for d in problems(nameless)] == [("syntax", 2)]
    found = problems(nameless + RUN.format("Go").replace("one", "other") + RUN.format("Hold"))
    assert [(d.name, d.span.line) for d in found] == [("syntax", 2), ("unknown-skill", 12)]


def test_an_implementation_that_is_broken_declares_no_relation() -> None:
    text = f"{HEADER}skill Go {{\n in arm: ArmDevice\n pre arm leansAgainst arm\n noplan\n}}\n"
    found = problems(text + RUN.format("Go").replace("{\n run", "run {\n"))
    assert [(d.name, d.span.line) for d in found] == [("unknown-relation", 4), ("syntax", 7)]


def test_a_removed_parameter_of_a_function_is_one_error_for_all_its_calls() -> None:
    text = (
        f'{HEADER}function middle(arm: ArmDevice) -> Pose = python "skillc_runtime.world.places:across"\n'
        + skill("Go")
        + "impl one of Go {\n let a = middle(arm, 1 m)\n let b = middle(arm, 2 m)\n"
        + " do seq { Look(at: a) Look(at: b) }\n}\n"
        + "skill Look {\n in at: Pose\n noplan\n}\n"
        + RUN.format("Look")
    )
    errors = [found for found in problems(text) if found.severity == "error"]
    assert [(found.name, len(found.labels)) for found in errors] == [("wrong-argument-count", 2)]


def test_a_skill_that_lost_its_name_is_pointed_to() -> None:
    (found,) = problems(f"{HEADER}{skill('Grip')}{RUN.format('Hold')}")
    assert (found.name, found.span.line, found.fix) == ("unknown-skill", 6, None)
    assert [label.span.line for label in found.labels] == [2]


def test_a_second_step_after_do_is_one_error_that_names_the_block() -> None:
    text = HEADER + skill("Go") + "impl one of Go {\n do\n  Go(arm)\n  Go(arm)\n}\n"
    (found,) = problems(text)
    assert (found.name, found.span.line) == ("syntax", 9)
    assert [label.span.line for label in found.labels] == [7]


def test_a_forgotten_vocabulary_is_one_error_also_where_its_classes_are_types() -> None:
    text = (
        "use rparts\n\nskill Go {\n in arm: ArmDevice\n in tool: Tool\n in surface: Surface\n noplan\n}\n"
        + RUN.format("Go")
    )
    (found,) = problems(text)
    assert found.fix is not None
    assert problems(apply_fixes(text, [found.fix])) == []


def test_an_output_that_a_syntax_error_removed_is_not_missed() -> None:
    text = HEADER + "skill Weigh {\n ojt mass: Mass\n noplan\n}\n" + RUN.format("Weigh") + skill("Go")
    text += "impl one of Go {\n do Weigh() -> mass\n}\n"
    assert [(found.name, found.span.line) for found in problems(text)] == [("syntax", 3)]


def test_an_output_without_a_value_is_one_error_where_it_is_read() -> None:
    text = HEADER + "skill Weigh {\n out mass: Mass\n noplan\n}\n" + RUN.format("Weigh") + skill("Note")
    text += "skill Go {\n in arm: ArmDevice\n out mass: Mass\n noplan\n}\n"
    text += "impl one of Go {\n do seq {\n  Weigh()\n  if mass > 1 g {\n   wait 1 s\n  }\n }\n}\n"
    errors = [found.name for found in problems(text) if found.severity == "error"]
    assert errors == ["out-unassigned"]


SHARED = """\
use rparts, skillc
skill Fill {
    in  arm:   ArmDevice
    opt limit: Mass
    out mass:  Mass
    post done: arm.deviceState == Idle
    noplan
}
impl once of Fill {
    let least = 1 g
    do seq {
        Measure(arm) -> mass
        if given limit {
            check(limit > 1 g)
        }
        check(mass > 2 * least)
        apply done
    }
}
impl twice of Fill {
    prefer 1
    do seq {
        Measure(arm) -> mass
        apply done
    }
}
skill Measure {
    in  arm:  ArmDevice
    out mass: Mass
    noplan
}
impl one of Measure { run python "skillc.primitives:StandIn" }
skill Ask {
    in  arm: ArmDevice
    post arm.deviceState == Idle
    noplan
}
impl one of Ask { do Fill(arm) -> mass }
"""


@pytest.mark.parametrize(
    ("before", "after", "found"),
    [
        ("given limit {", "given limmit {", ("unknown-parameter", 13)),
        ("let least", "let limit", ("duplicate-name", 10)),
        ("    post done: arm.deviceState == Idle\n    noplan", "    noplan", ("unknown-label", 16)),
        ("out mass:  Mass\n    post", "out maass:  Mass\n    post", ("out-never-assigned", 9)),
    ],
)
def test_what_several_implementations_or_callers_miss_is_one_error(
    before: str, after: str, found: tuple[str, int]
) -> None:
    assert problems(SHARED) == []
    wrong = SHARED.replace(before, after, 1)
    assert [(d.name, d.span.line) for d in problems(wrong) if d.severity == "error"] == [found]


def test_a_relation_with_the_name_of_a_skill_hides_no_unknown_name() -> None:
    text = f"{HEADER}relation Go(ArmDevice, Location)\nskill Go {{\n in arm: ArmDevice\n pre arm leansAgainst arm\n"
    found = problems(text + " noplan\n}\n" + RUN.format("Go"))
    assert [d.name for d in found if d.severity == "error"] == ["unknown-relation"]
