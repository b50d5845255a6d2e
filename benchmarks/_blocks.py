"""Random problems of the blocks world: as a library with a scene and a goal, and in the PDDL of the IPC."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

Pairs: TypeAlias = tuple[tuple[str, str | None], ...]
"""Each block with the one below it; None on the table."""

_HEADER = """use skiros, sumo

class    Block < Location
class    Hand < Agent
relation on(Block, Block)  functional
relation holds(Hand, Block)  functional
property onTable(Block): Bool
"""
_FREE, _EMPTY = "not _ on block", "not hand holds _"
_SKILLS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "PickUp": (("block.onTable == true", _FREE, _EMPTY), ("hand holds block", "block.onTable == false")),
    "PutDown": (("hand holds block",), ("not hand holds block", "block.onTable == true")),
    "Stack": (
        ("hand holds block", "not _ on below", "not block == below"),
        ("block on below", "not hand holds block"),
    ),
    "Unstack": (("block on below", _FREE, _EMPTY), ("hand holds block", "not block on below")),
}
"""Preconditions and postconditions."""

DOMAIN = """(define (domain blocks)
  (:requirements :strips :action-costs)
  (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (handempty) (holding ?x))
  (:functions (total-cost) - number)
  (:action pick-up :parameters (?x)
    :precondition (and (clear ?x) (ontable ?x) (handempty))
    :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x) (increase (total-cost) 1)))
  (:action put-down :parameters (?x)
    :precondition (holding ?x)
    :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x) (increase (total-cost) 1)))
  (:action stack :parameters (?x ?y)
    :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y) (increase (total-cost) 1)))
  (:action unstack :parameters (?x ?y)
    :precondition (and (on ?x ?y) (clear ?x) (handempty))
    :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y))
                 (increase (total-cost) 1))))
"""
"""The domain of the IPC, with the cost of each step."""


@dataclass(frozen=True)
class Blocks:
    """Where the blocks stand, and where they shall."""

    start: Pairs
    end: Pairs

    @staticmethod
    def draw(count: int, seed: int) -> Blocks:
        """Return a random problem."""
        draw = random.Random(f"{count} {seed}")
        names = [f"b{number}" for number in range(count)]
        return Blocks(tuple(_towers(names, draw)), tuple(_towers(names, draw)))

    @property
    def scene(self) -> str:
        """The scene in Turtle."""
        where = (
            f"own:onTable {'false' if below else 'true'}{f' ; own:on lab:{below}' if below else ''}"
            for _, below in self.start
        )
        blocks = (f"lab:{block} a own:Block ; {place} ." for (block, _), place in zip(self.start, where, strict=True))
        return "\n".join((PREFIXES, "lab:Hand a own:Hand .", *blocks, ""))

    @property
    def goal(self) -> str:
        """The goal, with bare names."""
        return " and ".join(f"lab:{block} on lab:{below}" for block, below in self.end if below)

    @property
    def problem(self) -> str:
        """The problem in PDDL."""
        init = [f"(on {block} {below})" if below else f"(ontable {block})" for block, below in self.start]
        init += [f"(clear {block})" for block, _ in self.start if block not in {below for _, below in self.start}]
        goal = " ".join(f"(on {block} {below})" for block, below in self.end if below)
        return (
            f"(define (problem drawn) (:domain blocks) (:objects {' '.join(block for block, _ in self.start)})\n"
            f"(:init {' '.join(init)} (handempty) (= (total-cost) 0))\n"
            f"(:goal (and {goal})) (:metric minimize (total-cost)))\n"
        )


PREFIXES = """@prefix lab: <http://example.org/lab#> .
@prefix own: <https://w3id.org/skillc/library/blocks#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Scene-1 a skiros:Scene ."""


def library() -> str:
    """Return the library, in which `on` and `holds` are functional."""
    return _HEADER + "".join(_skill(name, *conditions) for name, conditions in _SKILLS.items())


def _skill(name: str, pre: tuple[str, ...], post: tuple[str, ...]) -> str:
    below = "    in   below: Block\n" if "below" in " ".join(pre) else ""
    conditions = "".join(f"    pre  {each}\n" for each in pre)
    conditions += "".join(f"    post p{number}: {each}\n" for number, each in enumerate(post))
    written = ", ".join(f"p{number}" for number in range(len(post)))
    return (
        f"\nskill {name} {{\n    in   block: Block\n{below}    in   hand: Hand\n{conditions}    duration 1 s\n}}\n"
        f"\nimpl hand of {name} {{\n    do seq {{\n        wait 1 s\n        apply {written}\n    }}\n}}\n"
    )


def _towers(names: list[str], draw: random.Random) -> Iterator[tuple[str, str | None]]:
    """Yield each block with the one below it, of random towers."""
    tops: list[str] = []
    for block in draw.sample(names, len(names)):
        place = draw.randrange(len(tops) + 1)
        below = tops[place] if place < len(tops) else None
        tops[place : place + 1] = [block]
        yield block, below
