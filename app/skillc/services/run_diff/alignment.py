"""Pairs the items of two sequences by what they are, so that one more item does not shift all that follow."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from difflib import SequenceMatcher
from itertools import takewhile
from typing import TypeVar

T = TypeVar("T")


def align(
    first: Sequence[T], second: Sequence[T], *keys: Callable[[T], Hashable]
) -> Iterator[tuple[T, T] | tuple[T, None] | tuple[None, T]]:
    """Yield the items of both in order, those with an equal key in pairs, the others with None.

    Items that the first key does not pair are paired by the next one.
    """
    key, *others = keys
    same = len(list(takewhile(lambda pair: key(pair[0]) == key(pair[1]), zip(first, second, strict=False))))
    yield from zip(first[:same], second[:same], strict=True)
    first, second = first[same:], second[same:]
    matcher = SequenceMatcher(None, list(map(key, first)), list(map(key, second)), autojunk=False)
    for kind, begin, end, other_begin, other_end in matcher.get_opcodes():
        one, other = first[begin:end], second[other_begin:other_end]
        if kind == "equal":
            yield from zip(one, other, strict=True)
        elif others and one and other:
            yield from align(one, other, *others)
        else:
            yield from ((item, None) for item in one)
            yield from ((None, item) for item in other)
