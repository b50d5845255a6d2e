"""Which of the names that exist is meant by one that does not."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
MOST = 3
"""The maximum number of names that are suggested."""
_REMEMBERED = 1 << 16
"""How many pairs of names are remembered: a library is compiled again for each fix that may be offered."""


def did_you_mean(wrong: str, candidates: Iterable[str]) -> str:
    """Return a help line with the names that are probably meant, or with all if they are few and none is close."""
    names = sorted(set(candidates))
    near = close_names(wrong, names)
    if near:
        return f"did you mean {' or '.join(f'`{name}`' for name in near)}?"
    if 0 < len(names) <= 8:
        return f"there is {', '.join(f'`{name}`' for name in names)}"
    return ""


def close_names(wrong: str, candidates: Iterable[str]) -> tuple[str, ...]:
    """Return up to MOST names that `wrong` is probably meant to be, the closest first.

    A name is close if it is spelt alike, with few changes for its length, or if it has all words of the other or the
    same words in another order, as `ArmDevice` has the word of `Arm`.
    """
    names = sorted({*candidates} - {wrong})
    near = alike_names(wrong, names)
    if near:
        return near
    words = set(split_words(wrong))
    shared = [name for name in names if words and len(wrong) >= 3 and _share_words(words, set(split_words(name)))]
    return tuple(sorted(shared, key=lambda name: (not _begins_alike(wrong, name), len(name), name))[:MOST])


def alike_names(wrong: str, candidates: Iterable[str]) -> tuple[str, ...]:
    """Return up to MOST names that are spelt like `wrong`, with equally few changes."""
    names = sorted({*candidates} - {wrong})
    near = [(distance, name) for name in names if (distance := _distance(wrong, name)) is not None]
    return tuple(name for distance, name in sorted(near) if distance == min(near)[0])[:MOST]


def split_words(name: str) -> tuple[str, ...]:
    """Return the words of a name in lower case: `GripperEffector` has `gripper` and `effector`."""
    return tuple(word.lower() for word in _WORD.findall(name.rpartition(":")[2]))


def _begins_alike(wrong: str, name: str) -> bool:
    return name.lower().startswith(wrong.lower())


def _share_words(one: set[str], other: set[str]) -> bool:
    """Whether one name has all words of the other."""
    return bool(one and other) and (one <= other or other <= one)


@lru_cache(_REMEMBERED)
def _distance(wrong: str, name: str) -> int | None:
    """Return the number of changes from one name to the other, None if they are too many for the length."""
    length = min(len(wrong), len(name))
    most = 0 if length < 2 else 1 if length < 6 else 2
    if abs(len(wrong) - len(name)) > most:
        return None
    found = _edits(wrong.lower(), name.lower(), most)
    return found if found <= most else None


def _edits(one: str, other: str, most: int) -> int:
    """Return the letters to insert, delete, replace or exchange with the next; more than `most` if there are more."""
    before, last, row = [0], [0], list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        before, last, row = last, row, [i]
        for j, against in enumerate(other, 1):
            cost = min(row[j - 1] + 1, last[j] + 1, last[j - 1] + (letter != against))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == against:
                cost = min(cost, before[j - 2] + 1)
            row.append(cost)
        if min(row) > most:
            return most + 1
    return row[-1]
