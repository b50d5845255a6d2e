"""Deliveries on a random tree of roads, among many parts that nobody asks for: as a library with a scene and a goal."""

from __future__ import annotations

import random

LIBRARY = """use skiros, cora, rparts

relation road(Location, Location)  symmetric

skill Drive {
    in   robot: Robot
    in   from:  Location
    in   to:    Location
    pre  robot at from
    pre  from road to
    post there: robot at to
    duration 5 s
}

skill Pick {
    in   robot:   Robot
    in   gripper: GripperEffector
    in   part:    Product
    in   from:    Location
    pre  robot hasA gripper
    pre  robot at from
    pre  from contain part
    pre  not gripper contain _
    post held: gripper contain part
    post gone: not from contain part
    duration 2 s
}

skill Place {
    in   robot:   Robot
    in   gripper: GripperEffector
    in   part:    Product
    in   to:      Location
    pre  robot hasA gripper
    pre  robot at to
    pre  gripper contain part
    post there: to contain part
    post gone: not gripper contain part
    duration 2 s
}

impl plain of Drive {
    do seq {
        wait 1 s
        apply there
    }
}

impl plain of Pick {
    do seq {
        wait 1 s
        apply held, gone
    }
}

impl plain of Place {
    do seq {
        wait 1 s
        apply there, gone
    }
}
"""

PREFIXES = """@prefix lab: <http://example.org/lab#> .
@prefix own: <https://w3id.org/skillc/library/roads#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
lab:Scene-1 a skiros:Scene .
"""
ONE_ROBOT = """lab:Robot a cora:Robot ; skiros:at lab:place-0 ; skiros:hasA lab:Gripper .
lab:Gripper a rparts:GripperEffector .
"""


def draw_scene(places: int, parts: int, seed: int) -> str:
    """Return a robot, places on a random tree of roads, and parts at random places, in Turtle."""
    draw = random.Random(f"{places} {parts} {seed}")
    lines = [PREFIXES, ONE_ROBOT, "lab:place-0 a skiros:Location ."]
    lines += (
        f"lab:place-{number} a skiros:Location ; own:road lab:place-{draw.randrange(number)} ."
        for number in range(1, places)
    )
    for number in range(parts):
        place = draw.randrange(places)
        lines += (f"lab:part-{number} a skiros:Product .", f"lab:place-{place} skiros:contain lab:part-{number} .")
    return "\n".join((*lines, ""))


def draw_fleet(robots: int, width: int, parts: int, seed: int) -> str:
    """Return robots and parts at random places of a square grid of roads, `width` places wide, in Turtle."""
    draw, places = random.Random(f"fleet {robots} {width} {parts} {seed}"), width * width
    lines = [PREFIXES]
    for n in range(places):
        lines.append(f"lab:place-{n} a skiros:Location .")
        lines += [f"lab:place-{n} own:road lab:place-{n + 1} ."] if (n + 1) % width else []
        lines += [f"lab:place-{n} own:road lab:place-{n + width} ."] if n + width < places else []
    for n in range(robots):
        lines.append(f"lab:robot-{n} a cora:Robot ; skiros:at lab:place-{draw.randrange(places)} .")
        lines.append(f"lab:robot-{n} skiros:hasA lab:gripper-{n} . lab:gripper-{n} a rparts:GripperEffector .")
    for n in range(parts):
        lines.append(
            f"lab:part-{n} a skiros:Product . lab:place-{draw.randrange(places)} skiros:contain lab:part-{n} ."
        )
    return "\n".join((*lines, ""))


def draw_goal(places: int, deliveries: int, seed: int) -> str:
    """Return where the first parts shall be."""
    draw = random.Random(f"goal {places} {seed}")
    return " and ".join(f"lab:place-{draw.randrange(places)} contain lab:part-{n}" for n in range(deliveries))
