"""Reports find what was wiped by what primitives declare, whatever the skills are called."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import skillc_runtime
import skillc_skills
from skillc_model.format_type import SI_UNITS
from skillc_rdf.vocabulary.types import Position
from skillc_runtime.evaluation.report.choice_listener import ChoiceListener
from skillc_runtime.evaluation.report.wiping import Wiping, find_wipings
from skillc_runtime.recording.events import ImplementationChosen, NodeEnded, NodeStarted
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.state.labelled import LabelledIri, LabelledValue, Quantity
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


def call(number: int, ended: float, *below: NodeOutcome) -> NodeOutcome:
    return NodeOutcome(
        id=number, name="", kind="call", status="success", source=HERE, started=1.0, ended=ended, children=below
    )


def choice(node: int, skill: str, activity: str = "", **bindings: LabelledValue) -> ImplementationChosen:
    return ImplementationChosen(
        time=1.0, node=node, skill=skill, implementation="x", bindings=bindings, activity=activity, source=HERE
    )


def choices(pressing: str, following: str) -> ChoiceListener:
    found = ChoiceListener()
    for event in (
        choice(1, "Wash", window=iri("Window"), with_tool=iri("Sponge"), arm=iri("Arm")),
        choice(2, "Lean", pressing, arm=iri("Arm"), force=Quantity(7.5, SI_UNITS["Force"])),
        choice(3, "Along", following, arm=iri("Arm")),
        NodeStarted(time=2.0, node=3, parent=1, kind="call", name="Along", source=HERE),
        NodeEnded(time=5.0, node=3, name="Along", status="success", source=HERE),
    ):
        found(event)
    return found


TREE = call(1, 6.0, call(2, 2.0), call(3, 5.0))


def test_a_surface_is_wiped_where_a_tool_is_pressed_and_led_along_a_path() -> None:
    wiping = Wiping("http://lab#Window", "http://lab#Arm", "http://lab#Sponge", 7.5, 1.0, ((2.0, 5.0),))
    assert find_wipings([TREE], choices("press", "follow-path"), STATE) == (wiping,)


def test_nothing_is_wiped_where_nothing_is_pressed_or_led() -> None:
    assert find_wipings([TREE], choices("", "follow-path"), STATE) == ()
    assert find_wipings([TREE], choices("press", ""), STATE) == ()


def test_only_primitives_know_the_names_of_shipped_skills() -> None:
    folder = Path(skillc_runtime.__path__[0])
    texts = [file.read_text(encoding="utf-8") for file in Path(skillc_skills.__path__[0]).rglob("*.skill")]
    names = {name for text in texts for name in re.findall(r"^skill (\w+)", text, re.MULTILINE)}
    assert len(names) > 30
    found = [
        (str(file.relative_to(folder)), node.value)
        for file in folder.rglob("*.py")
        if "primitives" not in file.parts
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and node.value in names
    ]
    assert found == []
