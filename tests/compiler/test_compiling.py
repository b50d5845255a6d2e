"""The pipeline as a whole: shipped libraries, determinism, what is left out, ranks, folding, effects, imports."""

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shipped import library, shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_compiler.problems import visible_diagnostics
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.source import Source, Span
from skillc_model import codec
from skillc_model.conditions import And, Arithmetic, Assign, Given, Literal, Not, Or, Retract
from skillc_model.rewriting import constant_number
from skillc_model.skills import Compound, SkillLibrary
from skillc_model.tree import Sequence, Wait

HEADER = "use skiros, rparts, skillc\n"


def compiled(*texts: str) -> Outcome[SkillLibrary]:
    sources = [Source(f"file{number}.skill", HEADER + text) for number, text in enumerate(texts, 1)]
    return compile(sources, vocabulary(), shelf(), "own")


def errors(outcome: Outcome[SkillLibrary]) -> list[str]:
    return [d.name for d in outcome.diagnostics if d.severity == "error"]


def test_shipped_libraries_have_no_errors() -> None:
    standard = compile(list(shelf().values()), vocabulary(), shelf(), "std")
    wiping = compile(library("wiping"), vocabulary(), shelf(), "wiping")
    assert errors(standard) == [] and errors(wiping) == []
    assert {"MoveTo", "Push", "MoveArc"} <= standard.value.skills.keys()
    assert {"clean_table", "clean_whiteboard"} <= wiping.value.tasks.keys()
    for found in (standard.value, wiping.value):
        assert all(found.implementations_of(skill) for skill in found.skills)


def test_the_same_library_whatever_the_order_of_the_files() -> None:
    sources = library("wiping")
    first = compile(sources, vocabulary(), shelf(), "wiping").value
    shuffled = random.Random(4).sample(sources, len(sources))
    assert codec.dumps(compile(shuffled, vocabulary(), shelf(), "wiping").value) == codec.dumps(first)
    assert codec.loads(codec.dumps(first), "wiping") == first
    changed = [Source(sources[0].path, sources[0].text + "\n"), *sources[1:]]
    assert compile(changed, vocabulary(), shelf(), "wiping").value.hash != first.hash


def test_the_same_bytes_in_every_process() -> None:
    script = "import sys; sys.path.insert(0, sys.argv[1]); import shipped as s; from skillc_compiler import pipeline; "
    script += "from skillc_model import codec; "
    script += "o = pipeline.compile(s.library('wiping'), s.vocabulary(), s.shelf(), 'wiping'); "
    script += "sys.stdout.buffer.write(codec.dumps(o.value)); print(o.diagnostics)"
    here = str(Path(__file__).parent)
    runs = {
        subprocess.run(
            [sys.executable, "-c", script, here], env={"PYTHONHASHSEED": seed}, capture_output=True, check=True
        ).stdout
        for seed in ("1", "2")
    }
    assert len(runs) == 1


def test_what_has_errors_is_left_out_with_what_calls_it() -> None:
    outcome = compiled(
        "skill Bad { in arm: ArmDevise noplan }\n"
        'impl plain of Bad { run python "m:Bad" }\n'
        "skill Good { in arm: ArmDevice noplan }\n"
        'impl plain of Good { run python "skillc.primitives:StandIn" }\n'
        "impl through_bad of Good { do Bad(arm) }\n"
    )
    assert errors(outcome) == ["unknown-class"]
    assert sorted(outcome.value.skills) == ["Good"]
    assert sorted(outcome.value.implementations) == ["Good.plain"]
    assert outcome.value.skills["Good"].implementations == ("plain",)


def test_rank_is_specificity_then_preference_then_order() -> None:
    bodies = {
        "any": "",
        "liked": "prefer 2",
        "gripper": "refine tool: GripperEffector",
        "wsg": "refine tool: WsgGripper",
        "robotiq": "refine tool: RobotiqGripper prefer 1",
        "later": "",
    }
    impls = [f'impl {name} of Use {{ {body} run python "m:{name}" }}' for name, body in bodies.items()]
    outcome = compiled("skill Use { in tool: EndEffector noplan }\n" + "\n".join(impls))
    assert errors(outcome) == []
    assert outcome.value.skills["Use"].implementations == ("robotiq", "wsg", "gripper", "liked", "any", "later")


def test_an_implementation_is_complete() -> None:
    outcome = compiled(
        "skill Use { in tool: EndEffector opt force: Force = 20 N range 1 N .. 100 N\n"
        "    pre tool.deviceState == Idle\n    post done: tool.deviceState == Busy\n    duration 4 s }\n"
        "impl wsg of Use { refine tool: WsgGripper refine force: Force = 10 N range 5 N .. 80 N\n"
        '    pre tool.deviceState != Fault\n    let twice = 2 * force\n    run python "m:Use" }\n'
    )
    assert errors(outcome) == []
    made = outcome.value.implementations["Use.wsg"]
    force = made.parameters[1]
    assert (force.default, force.low, force.high) == (Literal(10.0), 5.0, 80.0)
    assert [r.label for r in made.pre] == ["pre1", "pre2"]
    assert [p.label for p in made.post] == ["done"]
    assert made.duration == Literal(4.0)
    assert isinstance(made.lets[0].value, Arithmetic)


def test_constants_are_folded_and_implies_is_spelled_out() -> None:
    outcome = compiled(
        "skill Use { in arm: ArmDevice in pace: Speed opt speed: Speed\n"
        "    pre given speed implies speed < 2 * 5 cm/s + 0.1 m/s\n"
        "    post sensed arm.deviceState == Idle and not arm hasGripper _ }\n"
        "impl one of Use { do seq { wait 2 * 250 ms wait 1 m / pace\n"
        "    check(arm.deviceState == Idle and not arm hasGripper _) } }\n"
    )
    assert errors(outcome) == []
    premise = outcome.value.skills["Use"].pre[0].condition
    assert isinstance(premise, Or) and premise.parts[0] == Not(Given("speed"))
    compared = premise.parts[1]
    assert constant_number(compared.right) == 0.2  # type: ignore[union-attr]
    made = outcome.value.implementations["Use.one"].body
    assert isinstance(made, Compound) and isinstance(made.node, Sequence)
    half, open_, _ = made.node.children
    assert isinstance(half, Wait) and half.seconds == Literal(0.5)
    assert isinstance(open_, Wait) and isinstance(open_.seconds, Arithmetic)
    post = outcome.value.skills["Use"].post[0]
    assert isinstance(post.condition, And)
    assert [type(effect) for effect in post.effects] == [Assign, Retract]


def test_only_what_is_imported_is_visible() -> None:
    declares = "skill Use { in arm: ArmDevice noplan }\nimpl one of Use { do TakePosture(arm) }\n"
    uses = "impl two of Use { do TakePosture(arm) }\n"
    missing = compiled('import "motion.skill"\n' + declares, 'import "motion.skill"\n' + uses)
    assert errors(missing) == ["unknown-skill"]
    helps = [d.help for d in missing.diagnostics if d.name == "unknown-skill"]
    assert helps == ['it is declared in file1.skill: write `import "file1.skill"` at the top']
    found = compiled('import "motion.skill"\n' + declares, 'import "motion.skill"\nimport "file1.skill"\n' + uses)
    assert errors(found) == []
    assert found.value.skills["Use"].implementations == ("one", "two")


def test_warnings_are_told_of_the_library_itself_only() -> None:
    imported = Source("std/rest.skill", HEADER + "skill Rest { in arm: ArmDevice }\nimpl one of Rest { do wait 1 s }\n")
    own = Source("own.skill", 'use rparts\nimport "rest.skill"\nimpl two of Rest {\n    prefer 1\n    do wait 1 s\n}\n')
    outcome = compile([own], vocabulary(), {"rest.skill": imported}, "own")
    assert [(d.name, d.span.path) for d in outcome.diagnostics] == [("unused-use", "own.skill")]
    alone = compile([imported], vocabulary(), {}, "std")
    assert {d.name for d in alone.diagnostics} == {"unused-use", "unused-parameter", "no-effect"}


def test_imports_in_a_circle_are_told_and_both_files_are_read() -> None:
    skill = 'skill {0} {{ in arm: ArmDevice noplan }}\nimpl one of {0} {{ run python "m:One" }}\n'
    outcome = compiled('import "file2.skill"\n' + skill.format("A"), 'import "file1.skill"\n' + skill.format("B"))
    assert errors(outcome) == ["import-cycle"]
    assert sorted(outcome.value.skills) == ["A", "B"]


@pytest.mark.slow
@settings(max_examples=int(os.environ.get("SKILLC_DAMAGES", "20")))
@given(st.data())
def test_damaged_libraries_never_crash(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(library("wiping"))).text
    lines = text.split("\n")
    gone = data.draw(st.sets(st.integers(0, len(lines) - 1), max_size=6))
    left = "\n".join(line for number, line in enumerate(lines) if number not in gone)
    words = sorted(set(left.replace("(", " ").replace(")", " ").split()))
    one, other = data.draw(st.sampled_from(words)), data.draw(st.sampled_from(words))
    outcome = compile([Source("x.skill", left.replace(one, other))], vocabulary(), shelf(), "x")
    assert codec.loads(codec.dumps(outcome.value), "x") == outcome.value
    assert all(d.message and d.span.line >= 1 for d in outcome.diagnostics)


def test_many_comments_before_a_mistake_are_read_once() -> None:
    text = 60 * "# # a comment # with marks  #\n" + "skil"
    outcome = compile([Source("own.skill", text)], vocabulary(), {}, "own")
    assert [problem.name for problem in outcome.diagnostics] == ["syntax"]


def test_the_order_of_what_is_told_at_one_place_is_always_the_same() -> None:
    source = Source("own.skill", "")
    place = Span("own.skill", 1, 1, 1, 2)
    twice = [
        Diagnostic("out-unassigned", place, "it has no value", help_, "warning") for help_ in ("pass it", "set it")
    ]
    first, second = (visible_diagnostics(each, (source,)) for each in (twice, twice[::-1]))
    assert first == second == tuple(twice)
