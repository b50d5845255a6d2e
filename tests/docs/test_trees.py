"""The page on trees names every node, and what it says of its examples is what happens."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from docs.pages import ROOT
from skillc.services.library import libraries
from skillc_compiler import pipeline
from skillc_dsl.source import Source
from skillc_model.conditions import Expression, Individual
from skillc_model.skills import SkillLibrary
from skillc_model.tree import Call
from skillc_runtime.execution.tree import build
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState
from tree.library import here
from tree.stage import Script, Scripted, Stage

PAGE = (ROOT / "docs/trees.md").read_text(encoding="utf-8")
NS = "https://w3id.org/skillc/library/shown#"
TICK_S = 0.01
ARGUMENTS: dict[str, Expression] = {name: Individual(f"{NS}{name}") for name in ("arm", "lamp")}
CALL = Call(skill="Show", implementation=None, arguments=ARGUMENTS, out=None, source=here())
SCRIPTS = {
    "Left": Script(ticks=3),
    "Right": Script(ticks=3),
    "Fails": Script("fail", ticks=3),
    "Refuses": Script("refuse"),
    "Light": Script(),
    "Guard": Script(),
}
LIBRARY = Path(__file__).with_name("trees.skill").read_text(encoding="utf-8")


class Shown(Scripted):
    """Does what the page says of a skill with its name."""

    def __init__(self, cell: Stage, **arguments: str) -> None:
        super().__init__(cell, name=type(self).__name__)

    def tick(self) -> Status:
        status = super().tick()
        if status is Status.SUCCESS:
            self.stage.tell("end", self.name)
        return status


class Left(Shown):
    def __init__(self, cell: Stage, *, arm: str) -> None:
        super().__init__(cell)


class Right(Left): ...


class Fails(Left): ...


class Refuses(Left): ...


class Guard(Left): ...


class Light(Shown):
    def __init__(self, cell: Stage, *, lamp: str) -> None:
        super().__init__(cell)


def rows(heading: str) -> list[list[str]]:
    """Return the cells of the tables below a heading, without their heads."""
    section = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    tables = [part.splitlines() for part in section.split("\n\n") if part.lstrip().startswith("|")]
    lines = [line for table in tables for line in [each for each in table if each][2:]]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_every_node_has_a_row() -> None:
    def kinds(cls: type[Node]) -> set[str]:
        own = {cls.kind} if "kind" in vars(cls) else set()
        return own.union(*map(kinds, cls.__subclasses__()))

    assert build is not None, "it imports all kinds"
    assert sorted(row[0].strip("`") for row in rows("Every node")) == sorted(kinds(Node) - {"par"})


@cache
def shown(tree: str) -> SkillLibrary:
    post = "post lamp.lit == true" if "Light" in tree else ""
    text = LIBRARY.replace("POST", post).replace("TREE", tree)
    outcome = pipeline.compile([Source("shown.skill", text)], libraries.load_vocabulary(), {}, "shown")
    assert outcome.ok, outcome.diagnostics
    return outcome.value


@pytest.mark.parametrize(("tree", "meanwhile", "told"), rows("Examples"))
def test_an_example_is_what_happens(tree: str, meanwhile: str, told: str) -> None:
    library = shown(tree.strip("`"))
    individuals = [AddIndividual(f"{NS}arm", (f"{NS}Arm",)), AddIndividual(f"{NS}lamp", (f"{NS}Lamp",))]
    lit = SetProperty(f"{NS}lamp", f"{NS}lit", False)
    world = WorldModel(WorldState.empty(library.vocabulary).with_changes([*individuals, lit]))
    stage = Stage(world, {name: [script] for name, script in SCRIPTS.items()})
    run = TreeRun(CALL, library, stage)  # type: ignore[arg-type]
    for number in range(1, 20):
        stage.now = (number - 1) * TICK_S
        if (change := re.fullmatch(rf"{number}: (lit|dark)", meanwhile)) is not None:
            world.commit([SetProperty(f"{NS}lamp", f"{NS}lit", change[1] == "lit")])
        if run.tick() is not Status.RUNNING:
            break
    assert run.status is not Status.RUNNING
    assert describe(stage) == told


def describe(stage: Stage) -> str:
    """Return what primitives were told but for their ticks, as the page does."""
    ticks: dict[int, list[str]] = {}
    for when, what, name in stage.log:
        if what != "tick":
            ticks.setdefault(round(when / TICK_S) + 1, []).append(f"{what} {name}")
    return "; ".join(f"{number}: {', '.join(words)}" for number, words in ticks.items())
