"""Locks on what running skills use exclusively, and the calls that wait for it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, Protocol, TypeAlias

from skillc_dsl.position import Position

Holders: TypeAlias = frozenset[object]
"""Calls that may hold locks."""

Choices: TypeAlias = Sequence[Sequence[str]]
"""The individuals that a call may use: all of one choice."""


class LockingCall(Protocol):
    """A call as its locks see it: the node with the number `id`, at `source`."""

    id: int
    source: Position

    @property
    def skill_name(self) -> str:
        """The name of the skill."""
        ...


class User(NamedTuple):
    """Who uses an individual: a call of a task run, or, without a call, the run as a whole; `run` is empty in none."""

    call: LockingCall | None
    run: str

    def describe(self, run: str) -> str:
        """Return who it is, for somebody who looks at `run`."""
        if self.call is None:
            return self.run
        return self.call.skill_name if self.run == run else f"{self.call.skill_name} of {self.run}"


class Conflict(NamedTuple):
    """An individual that a call cannot have: `user` has it, or, unless it is `held`, waits for it and came first."""

    individual: str
    user: User
    held: bool = True


class Wait(NamedTuple):
    """A call that waits until all individuals of one of its choices are free."""

    user: User
    choices: Choices
    enclosing: tuple[object, ...]
    locks: DeviceLocks

    @property
    def individuals(self) -> frozenset[str]:
        """All individuals that it may use."""
        return frozenset(each for choice in self.choices for each in choice)


class Link(NamedTuple):
    """A call that waits, and for what; in a circle, the next one waits inside of what has that."""

    waiting: User
    conflict: Conflict

    def describe(self, individual: str, run: str) -> str:
        """Return who waits for what, for somebody who looks at `run`; `individual` is how that is called."""
        user = self.conflict.user.describe(run)
        why = f"which {user} uses" if self.conflict.held else f"after {user}"
        return f"{self.waiting.describe(run)} waits for {individual}, {why}"


class LockTable:
    """Who uses which individuals of a cell, by IRI, and the calls that wait, in the order in which they came.

    `changes` counts how often individuals became free, or a call ceased to wait.
    """

    def __init__(self) -> None:
        self.users: dict[str, list[User]] = {}
        self.waits: list[Wait] = []
        self.changes = 0


class DeviceLocks:
    """The locks of a run; runs that share individuals share a `table`.

    A holder is the node of a call. It may lock what is free or held by an enclosing call, so that skills nest. Nobody
    overtakes a call that has waited longer for the same individual, except where that one waits for what encloses it.
    """

    def __init__(self, table: LockTable | None = None, run: str = "") -> None:
        self.table, self.run = table or LockTable(), run

    def acquire(
        self, individuals: Iterable[str], holder: LockingCall, enclosing: tuple[object, ...]
    ) -> Conflict | None:
        """Lock all individuals or none; return what another call than `enclosing` has, or None on success."""
        wanted = tuple(dict.fromkeys(individuals))
        conflict = self.find_conflict(wanted, holder, enclosing)
        if conflict is None:
            self._forget_wait(holder)
            for individual in wanted:
                self.table.users.setdefault(individual, []).append(User(holder, self.run))
        return conflict

    def find_conflict(
        self, individuals: Iterable[str], holder: object, enclosing: tuple[object, ...], freed: Holders = frozenset()
    ) -> Conflict | None:
        """Return what `holder` could not have if the calls `freed` had none and waited for none; nothing is locked."""
        wanted = tuple(individuals)
        for individual in wanted:
            users = self.find_users(individual, enclosing, freed)
            if users:
                return Conflict(individual, users[-1])
        return self._find_earlier(wanted, holder, enclosing, freed) if self.table.waits else None

    def find_users(
        self, individual: str, enclosing: tuple[object, ...], freed: Holders = frozenset()
    ) -> Sequence[User]:
        """Return who has an individual, other than the calls `freed` and `enclosing`; the innermost last."""
        users = self.table.users.get(individual, ())
        return [user for user in users if user.call not in freed and user.call not in enclosing]

    def wait(self, holder: LockingCall, choices: Choices, enclosing: tuple[object, ...]) -> tuple[Link, ...]:
        """Let a call wait for one of several choices, at the place that it has; return the circle, if it is in one."""
        user = User(holder, self.run)
        place = next((n for n, each in enumerate(self.table.waits) if each.user.call is holder), None)
        entry = Wait(user, choices, (*enclosing, *self.outermost), self)
        if place is None:
            self.table.waits.append(entry)
        else:
            self.table.waits[place] = entry
        return tuple(_find_circle(entry, self.table.waits))

    def find_conflicts(self, call: LockingCall | None = None) -> Iterator[Link]:
        """Yield what a call waits for, or each call of the run, the one first that has waited longest."""
        for entry in self.table.waits:
            if entry.locks is self and call in (None, entry.user.call):
                found = self.find_conflict(entry.choices[0], entry.user.call, entry.enclosing)
                if found is not None:
                    yield Link(entry.user, found)

    def is_free(self, holder: object) -> bool:
        """Whether a call that waits can go on: one of its choices is free."""
        entry = next(each for each in self.table.waits if each.user.call is holder)
        return any(self.find_conflict(each, holder, entry.enclosing) is None for each in entry.choices)

    def release(self, holder: object) -> None:
        """Release all individuals that the holder has locked; it waits for none any more."""
        users = self.table.users
        held = [each for each, used in users.items() if any(user.call is holder for user in used)]
        for individual in held:
            users[individual] = [user for user in users[individual] if user.call is not holder]
            if not users[individual]:
                del users[individual]
        self.table.changes += bool(held)
        self._forget_wait(holder)

    def step_back(self, holder: LockingCall, enclosing: tuple[object, ...]) -> None:
        """Release what the holder has locked, which then is the first one to get it again."""
        held = [each for each, used in self.table.users.items() if any(user.call is holder for user in used)]
        self.release(holder)
        if held:
            self.wait(holder, (held,), enclosing)
            self.table.waits.insert(0, self.table.waits.pop())

    @property
    def held(self) -> frozenset[str]:
        """The individuals that calls of the run have locked."""
        return frozenset(each for each, used in self.table.users.items() if any(u.run == self.run for u in used))

    @property
    def outermost(self) -> tuple[object, ...]:
        """What encloses all calls of the run."""
        return ()

    def _forget_wait(self, holder: object) -> None:
        others = [each for each in self.table.waits if each.user.call is not holder]
        self.table.changes += len(others) < len(self.table.waits)
        self.table.waits = others

    def _find_earlier(
        self, wanted: tuple[str, ...], holder: object, enclosing: tuple[object, ...], freed: Holders
    ) -> Conflict | None:
        """Return what a call that came earlier waits for, unless it waits for what encloses this one."""
        around = (*enclosing, *self.outermost)
        for entry in self.table.waits:
            if entry.user.call is holder:
                return None
            shared = [each for each in wanted if each in entry.individuals and not self._is_inside(each, enclosing)]
            if shared and entry.user.call not in freed and not _depends_on(entry, around, self.table.waits, freed):
                return Conflict(shared[0], entry.user, held=False)
        return None

    def _is_inside(self, individual: str, enclosing: tuple[object, ...]) -> bool:
        """Whether an enclosing call has an individual."""
        return any(user.call in enclosing for user in self.table.users.get(individual, ()))


def describe_waits(links: Iterable[Link], short: Callable[[str], str], run: str) -> str:
    """Return who waits for what, for somebody who looks at `run`; `short` shortens IRIs."""
    return "; ".join(each.describe(short(each.conflict.individual), run) for each in links)


def describe_circle(circle: Sequence[Link], short: Callable[[str], str], run: str) -> str:
    """Return what each call in a circle waits for, for somebody who looks at `run`; `short` shortens IRIs."""
    links = [each.describe(short(each.conflict.individual), run) for each in circle]
    last = f"{circle[0].waiting.describe(run)} is in {circle[-1].conflict.user.describe(run)}"
    return f"a circle of waits: {'; in it, '.join(links)}; and {last}"


def _find_held(entry: Wait, choice: Sequence[str], freed: Holders = frozenset()) -> Iterator[Conflict]:
    """Yield what of a choice is used by others, and by whom."""
    for individual in choice:
        for user in entry.locks.find_users(individual, entry.enclosing, freed):
            yield Conflict(individual, user)


def _waits_inside(user: User, waits: Sequence[Wait]) -> Iterator[Wait]:
    """Yield the calls that wait inside of a call or a run."""
    around = user.call if user.call is not None else user.run
    return (each for each in waits if around in each.enclosing)


def _find_circle(entry: Wait, waits: Sequence[Wait]) -> Iterator[Link]:
    """Yield the circle of waits that a call closes: none of its members can go on before another one does.

    A call is stuck if, whatever it chooses, something is used by what a stuck call is inside of.
    """
    stuck, before = tuple(waits), 0
    while len(stuck) != before:
        before = len(stuck)
        stuck = tuple(each for each in stuck if all(_find_stuck(each, choice, stuck) for choice in each.choices))
    following = entry if any(each is entry for each in stuck) else None
    seen = list[Wait]()
    while following is not None and not any(each is following for each in seen):
        seen.append(following)
        found = _find_stuck(following, following.choices[0], stuck)
        assert found is not None, "a call that is stuck waits for what a stuck one is inside of"
        conflict, inside = found
        yield Link(following.user, conflict)
        following = inside


def _find_stuck(entry: Wait, choice: Sequence[str], stuck: Sequence[Wait]) -> tuple[Conflict, Wait] | None:
    """Return what of a choice is used by what a stuck call is inside of, with this call."""
    inside = ((each, next(_waits_inside(each.user, stuck), None)) for each in _find_held(entry, choice))
    return next(((conflict, wait) for conflict, wait in inside if wait is not None), None)


def _depends_on(entry: Wait, calls: tuple[object, ...], waits: Sequence[Wait], freed: Holders) -> bool:
    """Whether a call that waits may have to wait until one of `calls` ends; those in `freed` do not count."""
    seen, ahead = list[Wait](), [entry]
    while ahead:
        current = ahead.pop()
        seen.append(current)
        users = [each.user for choice in current.choices for each in _find_held(current, choice, freed)]
        if any((user.call if user.call is not None else user.run) in calls for user in users):
            return True
        inside = [wait for user in users for wait in _waits_inside(user, waits)]
        before = waits[: next(n for n, each in enumerate(waits) if each is current)]
        queued = [each for each in before if each.individuals & current.individuals]
        following = (each for each in (*inside, *queued) if each.user.call not in freed)
        ahead += [each for each in following if not any(each is one for one in (*seen, *ahead))]
    return False
