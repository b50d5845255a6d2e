"""Which file declares a name that another file does not see, so that a message can say what to import."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping, Set
from functools import lru_cache

import msgspec

from skillc_dsl.source import Source

_DECLARATION = re.compile(r"^(?:class|relation|property|function|skill)[ \t]+(\w+)", re.MULTILINE)
_FIRST = "std/"


class Homes(msgspec.Struct, frozen=True):
    """Where names are declared that are not `visible` in a file, which is in `folder`.

    `own` gives the path of the file of the library, `others` the text that imports another file.
    """

    own: Mapping[str, str]
    others: Mapping[str, str]
    visible: Set[str]
    folder: str

    def get(self, name: str) -> str | None:
        """Return the text that imports the file; None if the name is visible, or nothing declares it."""
        if name in self.visible:
            return None
        path = self.own.get(name)
        return self.others.get(name) if path is None else posixpath.relpath(path, self.folder or ".")


@lru_cache(maxsize=8)
def names_by_import(importable: tuple[tuple[str, Source], ...]) -> Mapping[str, str]:
    """Return the text that imports the file in which a name is declared, by name; those of `std` come first.

    The files are searched and not parsed, as most are never imported.
    """
    ordered = sorted(importable, key=lambda each: (not each[1].path.startswith(_FIRST), each[0]), reverse=True)
    return {name: wanted for wanted, source in ordered for name in _declared_in(source)}


@lru_cache(maxsize=2000)
def _declared_in(source: Source) -> tuple[str, ...]:
    return tuple(_DECLARATION.findall(source.text))
