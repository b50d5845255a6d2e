"""What can be reached in a drawn library, found by trying everything."""

from __future__ import annotations

from collections.abc import Sequence
from heapq import heappop, heappush
from itertools import count
from random import Random

from columns.meaning import Condition
from columns.skills import Skill
from columns.worlds import World, normal

MOST_STATES = 200


def walk(skills: Sequence[Skill], world: World, random: Random) -> World:
    """Return the world after some random steps."""
    for _ in range(4):
        ends = [after for each in skills for names in each.calls(world) for after in each.after(world, names).values()]
        new = [each for each in ends if each != world]
        world = random.choice(new) if new else world
    return world


def cheapest(skills: Sequence[Skill], start: World, goal: Condition) -> float | None:
    """Return what the cheapest plan takes if what comes of skills may be chosen, infinity if there is none.

    None if that takes too long to find out.
    """
    tie = count()
    ways, seen = [(0, next(tie), start)], set[World]()
    while ways:
        cost, _, world = heappop(ways)
        if normal(world) in seen:
            continue
        if goal.holds(world, {}):
            return float(cost)
        seen.add(normal(world))
        if len(seen) > MOST_STATES:
            return None
        for skill in skills:
            for names in skill.calls(world):
                for after in skill.after(world, names).values():
                    heappush(ways, (cost + skill.seconds, next(tie), after))
    return float("inf")


def can_reach(skills: Sequence[Skill], start: World, goal: Condition) -> bool:
    """Whether the goal can be reached whatever comes of each step, coming back to no world."""
    ways: dict[World, list[set[World]]] = {}
    waiting = [normal(start)]
    while waiting and len(ways) < MOST_STATES:
        world = waiting.pop(0)
        if world in ways:
            continue
        ends = [skill.after(world, names).values() for skill in skills for names in skill.calls(world)]
        ways[world] = [set(map(normal, each)) for each in ends if each]
        waiting += sorted({end for each in ways[world] for end in each}, key=lambda each: sorted(each.facts, key=str))
    sure = {world for world in ways if goal.holds(world, {})}
    while more := {world for world, ends in ways.items() if world not in sure and any(each <= sure for each in ends)}:
        sure |= more
    return normal(start) in sure
