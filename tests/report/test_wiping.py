"""Reports find what was wiped by what primitives declare, whatever the skills are called."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

import skillc_runtime
import skillc_skills
from skillc_dsl.position import Position
from skillc_model.format_type import SI_UNITS
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.report.wiping import Wiping, find_recorded_wipings, find_wipings
from skillc_runtime.recording.history.history import RecordedAttempt, RecordedCall, RunHistory
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledQuantity, LabelledValue
from skillc_runtime.world.state.terms import ARM_DEVICE, SURFACE, TOOL

HERE = Position("wash.skill", 1, 1)
CLASSES = {"http://lab#Window": SURFACE, "http://lab#Sponge": TOOL, "http://lab#Arm": ARM_DEVICE}
STATE: Any = SimpleNamespace(
    individuals=CLASSES,
    is_a=lambda individual, cls: CLASSES[individual] == cls,
    instances=lambda cls: {each for each, own in CLASSES.items() if own == cls},
)


def iri(name: str) -> LabelledIri:
    return LabelledIri(f"http://lab#{name}", f"lab:{name}")


def call(
    number: str,
    skill: str,
    started: float,
    ended: float,
    activity: str,
    *below: RecordedCall,
    **bindings: LabelledValue,
) -> RecordedCall:
    return RecordedCall(
        number=number, skill=skill, status="success", source=HERE, implementation="x", started=started, ended=ended,
        activity=activity, calls=below, bindings=bindings,
    )  # fmt: skip


def washed(pressing: str, following: str, start: float = 1.0) -> RecordedCall:
    """Return a call that presses and goes along a path for three seconds, one second after its start."""
    press = call(
        "1.1", "Lean", start, start + 1, pressing, arm=iri("Arm"), force=LabelledQuantity(7.5, SI_UNITS["Force"])
    )
    follow = call("1.2", "Along", start + 1, start + 4, following, arm=iri("Arm"))
    named = {"window": iri("Window"), "with_tool": iri("Sponge"), "arm": iri("Arm")}
    return call("1", "Wash", start, start + 5, "", press, follow, **named)


def history(*steps: RecordedCall) -> RunHistory:
    return RunHistory(task="wash", attempts=(RecordedAttempt(steps=steps),))


def test_a_surface_is_wiped_where_a_tool_is_pressed_and_led_along_a_path() -> None:
    wiping = Wiping("http://lab#Window", "http://lab#Arm", "http://lab#Sponge", 7.5, 1.0, ((2.0, 5.0),))
    assert find_wipings(history(washed("press", "follow-path")), STATE) == (wiping,)


def test_a_surface_that_is_wiped_again_has_two_wipings() -> None:
    once, again = washed("press", "follow-path"), washed("press", "follow-path", start=7.0)
    found = find_wipings(history(once, again), STATE)
    assert [each.strokes for each in found] == [((2.0, 5.0),), ((8.0, 11.0),)]


def test_nothing_is_wiped_where_nothing_is_pressed_or_led() -> None:
    assert find_wipings(history(washed("", "follow-path")), STATE) == ()
    assert find_wipings(history(washed("press", "")), STATE) == ()


def test_nothing_is_said_of_a_wiping_without_its_tool() -> None:
    """The tool was lost before: nothing was recorded of it while the path was followed."""
    done = history(washed("press", "follow-path"))
    for start, count in ((3.0, 1), (6.0, 0)):
        rows = np.zeros((100, 25))
        rows[:, 0] = start + np.arange(100) / 100
        truth: Any = SimpleNamespace(recording=lambda tool, rows=rows: Recording(rows))
        assert len(find_recorded_wipings(done, STATE, truth)) == count
    assert len(find_recorded_wipings(done, STATE, None)) == 1


def test_only_primitives_know_the_names_of_shipped_skills() -> None:
    folder = Path(skillc_runtime.__path__[0])
    texts = [file.read_text(encoding="utf-8") for file in Path(skillc_skills.__path__[0]).rglob("*.skill")]
    names = {name for text in texts for name in re.findall(r"^skill (\w+)", text, re.MULTILINE)}
    assert len(names) > 30
    named = re.compile(rf"['\"](?:{'|'.join(names)})['\"]")
    found = [
        (str(file.relative_to(folder)), node.value)
        for file in folder.rglob("*.py")
        if "primitives" not in file.parts and named.search(text := file.read_text(encoding="utf-8"))
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Constant) and node.value in names
    ]
    assert found == []
