"""What is made from the contract and from the descriptions of the language, in the order in which it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from clients import made_calls, made_requests, made_words
from clients.made_waiting import WAITING, make_waiting


@dataclass(frozen=True, slots=True)
class MadeModule:
    """A file, and what makes its text."""

    file: Path
    make: Callable[[], str]


MADE = (
    MadeModule(made_calls.FILE, made_calls.make_calls),
    *(MadeModule(each.file, partial(make_waiting, each)) for each in WAITING),
    MadeModule(made_requests.FILE, made_requests.make_requests),
    MadeModule(made_words.STUDIO, made_words.make_studio_words),
    MadeModule(made_words.VS_CODE, made_words.make_grammar),
    MadeModule(made_words.REFERENCE, made_words.make_reference),
    MadeModule(made_words.TREES, made_words.make_trees),
)
