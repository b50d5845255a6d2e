"""The types of the rows."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

Group: TypeAlias = Literal["declaration", "member", "flag", "trait", "step", "property", "logic", "constant"]
NamePlace: TypeAlias = Literal["nowhere", "anywhere", "leading", "trailing"]
"""Where a keyword is also a legal name: a `leading` one not after which a value may follow, a `trailing` one not where
a relation stands between two values."""
SlotKind: TypeAlias = Literal["count", "time"]
Outcome: TypeAlias = Literal["success", "failure", "again"]
PictureKind: TypeAlias = Literal["flow", "time", "guard", "call"]


class Word(msgspec.Struct, frozen=True):
    """A keyword, where it is also a legal name, and since which edition it is a keyword."""

    text: str
    name: NamePlace = "anywhere"
    since: int = 1


class Construct(msgspec.Struct, frozen=True):
    """Something that can be written: its words, the first one at its beginning, and an example of its form for help.

    `meaning` is its row of the reference in Markdown, empty if it has none. A `long` keyword does not widen the column
    of keywords when members are aligned.
    """

    group: Group
    words: tuple[Word, ...]
    written: str = ""
    meaning: str = ""
    long: bool = False


class Flag(msgspec.Struct, frozen=True):
    """A word alone on a line of a skill; it gives `value` to the field `field` of the compiled skill.

    `meaning` is its row of the reference, and `page` the sentence on the page of a skill that has it.
    """

    keyword: str
    meaning: str
    page: str
    field: str
    value: bool = True


class Picture(msgspec.Struct, frozen=True):
    """How a node is drawn: the kind of its box and a symbol."""

    kind: PictureKind
    symbol: str


class Node(msgspec.Struct, frozen=True):
    """A node of behaviour trees: its kind, its words, an example of its form, its row of the reference, its picture.

    Words that another node has too are listed there.
    """

    kind: str
    words: tuple[Word, ...]
    written: str
    meaning: str
    picture: Picture


class Slot(msgspec.Struct, frozen=True):
    """What stands between the word of a decorator and its braces: a whole number, or a time.

    `field` is where the compiled node has it, a time in seconds; `port` is that of BehaviorTree.CPP, a time in ms.
    """

    kind: SlotKind
    field: str
    port: str


class Ticks(msgspec.Struct, frozen=True):
    """What a node does at its start and in a tick, what it halts and releases, and what it is tried to be."""

    start: str
    tick: str
    halts: str
    tried: str


class Decorator(msgspec.Struct, frozen=True):
    """A node with one child, `WORD SLOT .. { .. }`; several steps in its braces are a sequence.

    `on_success` and `on_failure` say what it makes of the result of its child: a result, or another round. A broken
    hold condition stays a failure. `tree_cpp` is the node of BehaviorTree.CPP for it: empty if it has to be declared
    there, with `tree_cpp_doc` as its documentation. A node that turns failure into success also has to be where a hold
    condition may break.
    """

    word: Word
    written: str
    meaning: str
    ticks: Ticks
    picture: Picture
    tree_cpp: str = ""
    tree_cpp_doc: str = ""
    slots: tuple[Slot, ...] = ()
    on_success: Outcome = "success"
    on_failure: Outcome = "failure"

    @property
    def kind(self) -> str:
        """The word that it begins with."""
        return self.word.text

    @property
    def repeats(self) -> bool:
        """Whether the child may run in several rounds."""
        return "again" in (self.on_success, self.on_failure)


def words(texts: str, name: NamePlace = "anywhere", since: int = 1) -> tuple[Word, ...]:
    """Return the words of a text that are legal names in the same places, and keywords since the same edition."""
    return tuple(Word(text, name, since) for text in texts.split())


def reserved(texts: str) -> tuple[Word, ...]:
    """Return the words of a text, which are never names."""
    return words(texts, "nowhere")
