"""What waiting for a device means: in the order of arrival, unless the first one waits for what is around the other."""

from __future__ import annotations

from collections.abc import Generator, Iterator

from tree.reference_model import Model, Wait


def queue(wait: Wait, model: Model) -> Generator[None, None, bool]:
    """Wait until a device is free; return whether it is: in a circle it never will be, and in a dry model it is now."""
    model.waits.append(wait)
    try:
        while not _is_free(wait, model):
            if model.dry or _reaches(wait, wait, model, []):
                return False
            yield
        return True
    finally:
        model.waits.remove(wait)


def _is_free(wait: Wait, model: Model) -> bool:
    if any(_users(wait, model)):
        return False
    if any(key in wait.calls for key in model.locks.get(wait.device, ())):
        return True
    return all(_needs(each, wait.calls, model, []) for each in _before(wait, model))


def _users(wait: Wait, model: Model) -> Iterator[tuple[object, ...]]:
    """Yield the calls that have the device of a call that waits, and are not around it."""
    return (key for key in model.locks.get(wait.device, ()) if key not in wait.calls)


def _inside(wait: Wait, model: Model) -> Iterator[Wait]:
    """Yield the calls that wait inside of those that have the device of a call that waits."""
    return (each for key in _users(wait, model) for each in model.waits if key in each.calls)


def _before(wait: Wait, model: Model) -> list[Wait]:
    earlier = model.waits[: model.waits.index(wait)]
    return [each for each in earlier if each.device == wait.device]


def _reaches(wait: Wait, end: Wait, model: Model, seen: list[Wait]) -> bool:
    """Whether a call waits, over others, for what `end` is inside of."""
    if wait in seen:
        return False
    return any(each == end or _reaches(each, end, model, [*seen, wait]) for each in _inside(wait, model))


def _needs(wait: Wait, calls: tuple[object, ...], model: Model, seen: list[Wait]) -> bool:
    """Whether a call that waits may have to wait until one of `calls` ends."""
    if wait in seen:
        return False
    following = [*_inside(wait, model), *_before(wait, model)]
    return any(key in calls for key in _users(wait, model)) or any(
        _needs(each, calls, model, [*seen, wait]) for each in following
    )
