"""Names in the style of the language, of names in PDDL; each is given once."""

from __future__ import annotations

import re
from collections.abc import Iterable

from skillc_dsl.token_table import KEYWORDS, TYPES

_GAPS = re.compile(r"[^A-Za-z0-9]+")
_NUMBERED = re.compile(r"(.*?[A-Za-z])(\d+)")
_FREE = frozenset(("between", "of", "on", "steps", "use"))
"""Words of the language that nevertheless may name anything."""
_WORDS = (
    frozenset((*(word for words in KEYWORDS.values() for word in words), "after", "sensed", *TYPES, "Thing")) - _FREE
)
"""Words that mean something in some place: nothing is called like one of them, so that each name can stand anywhere."""


class Names:
    """Gives names, each once; capitals make no difference, as there are none in the domain that planners get."""

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._taken = {each.casefold() for each in taken}

    def give(self, name: str, otherwise: str = "") -> str:
        """Return the name; `otherwise` if it is a word of the language, one with a number if it is taken."""
        wanted = (otherwise or f"{name}1") if name in _WORDS else name
        chosen, number = wanted, 2
        while chosen.casefold() in self._taken or chosen in _WORDS:
            chosen, number = f"{wanted}{number}", number + 1
        self._taken.add(chosen.casefold())
        return chosen


def to_class(written: str) -> str:
    """Return a name as of a class or a skill: `pick-up` becomes `PickUp`."""
    return _begin_with_letter("".join(part[0].upper() + part[1:] for part in _parts(written)), "N")


def to_term(written: str) -> str:
    """Return a name as of a relation or a property: `on-table` becomes `onTable`."""
    name = to_class(written)
    return name.lower() if name.isupper() else name[0].lower() + name[1:]


def to_variable(written: str) -> str:
    """Return a name as of a parameter or a task: `?from-place` becomes `from_place`."""
    return _begin_with_letter("_".join(part.lower() for part in _parts(written)), "n")


def to_individual(written: str) -> str:
    """Return a name as of an individual: `truck1` becomes `Truck-1`."""
    parts = [part[0].upper() + part[1:] for part in _parts(written)]
    split = [f"{found[1]}-{found[2]}" if (found := _NUMBERED.fullmatch(part)) else part for part in parts]
    return _begin_with_letter("-".join(split), "N")


def _parts(written: str) -> list[str]:
    return [part for part in _GAPS.split(written) if part]


def _begin_with_letter(name: str, letter: str) -> str:
    return name if name[:1].isalpha() else f"{letter}{name}"
