"""Whether things hold each other in a circle: no axiom of OWL forbids one of more than two links."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.terms import CONTAIN, HAS_A
from skillc_runtime.world.state.world_state import WorldState


def check_containment(state: WorldState) -> Iterator[SceneViolation]:
    """Yield each circle of things of which each contains or has the next, once."""
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
            message = f"{first} is held by itself" + (f", by way of {' and '.join(others)}" if others else "")
            stated = circle[1 % len(circle)] in state.asserted[links[0]].forward.get(circle[0])
            help_ = "nothing is in itself; remove one of the links"
            yield SceneViolation(circle[0], links[0] if stated else None, "containment-circle", message, help_)


def _breaks_axiom(links: list[str], state: WorldState) -> bool:
    """Whether a circle of these relations is told as a breach of an axiom."""
    return len(links) <= 2 and len({*links}) == 1 and state.vocabulary.relations[links[0]].asymmetric


def _circle(start: str, held: dict[str, dict[str, str]], done: set[str]) -> list[str]:
    """Return the first circle found from a thing on, empty where there is none; `done` are those looked at."""
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
