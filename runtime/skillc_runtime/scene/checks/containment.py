"""Checks for cycles of containment; no axiom of OWL excludes cycles of more than two links."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.terms import CONTAIN, HAS_A
from skillc_runtime.world.state.world_state import WorldState


def check_containment(state: WorldState) -> Iterator[SceneViolation]:
    """Yield each cycle of objects that contain or have the next one, once."""
    holders = [(relation, state.asserted[relation]) for relation in (CONTAIN, HAS_A) if relation in state.asserted]
    held: dict[str, dict[str, str]] = {}
    for relation, _ in holders:
        for holder, thing in state.pairs(relation):
            held.setdefault(holder, {})[thing] = relation
    if all(each not in held for things in held.values() for each in things):
        return
    done: set[str] = set()
    for start in sorted(held):
        circle = _circle(start, held, done)
        links = [held[one][other] for one, other in zip(circle, [*circle[1:], *circle[:1]], strict=True)]
        if circle and not _breaks_axiom(links, state):
            first, *others = map(state.vocabulary.short, circle)
            message = f"{first} is held by itself" + (f", through {' and '.join(others)}" if others else "")
            stated = circle[1 % len(circle)] in state.asserted[links[0]].forward.get(circle[0])
            help_ = "an object cannot contain itself; remove one of the links"
            yield SceneViolation(circle[0], links[0] if stated else None, "containment-circle", message, help_)


def _breaks_axiom(links: list[str], state: WorldState) -> bool:
    """Whether a cycle of these relations is reported as a violation of an axiom."""
    return len(links) <= 2 and len({*links}) == 1 and state.vocabulary.relations[links[0]].asymmetric


def _circle(start: str, held: dict[str, dict[str, str]], done: set[str]) -> list[str]:
    """Return the first cycle that is reachable from an object, else an empty list; `done` are the visited objects."""
    path: list[str] = []
    place: dict[str, int] = {}
    todo: list[tuple[str, bool]] = [(start, True)]
    while todo:
        thing, enters = todo.pop()
        if not enters:
            path.pop()
            del place[thing]
        elif thing in place:
            return path[place[thing] :]
        elif thing not in done:
            done.add(thing)
            place[thing] = len(path)
            path.append(thing)
            todo.append((thing, False))
            todo += [(each, True) for each in sorted(held.get(thing, ()), reverse=True)]
    return []
