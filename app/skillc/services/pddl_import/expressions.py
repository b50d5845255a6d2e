"""The text of a PDDL file as nested expressions, each with its place."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NoReturn

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source, Span

_TOKEN = re.compile(r"[^\S\n]+|;[^\n]*|\n|[()]|[^\s();]+")
MOST_DEPTH = 200
"""How deep expressions may nest."""


class BrokenPddl(Exception):
    """Something in a PDDL file is wrong: `node` is where, the message what, `help` what to write instead."""

    def __init__(self, node: Node, message: str, help_: str = "") -> None:
        super().__init__(message)
        self.node, self.help = node, help_


class Missing(Exception):
    """The language cannot say what stands at `node`; the message is a sentence about it."""

    def __init__(self, node: Node, message: str) -> None:
        super().__init__(message)
        self.node = node


@dataclass(frozen=True, slots=True)
class Node:
    """A word, or a list of expressions in parentheses. `word` is in lower case, since PDDL ignores case."""

    span: Span
    word: str = ""
    written: str = ""
    items: tuple[Node, ...] = ()

    @property
    def is_list(self) -> bool:
        """Whether it is in parentheses."""
        return not self.word

    @property
    def head(self) -> str:
        """The word with which a list begins; empty if it begins with none."""
        return self.items[0].word if self.items else ""

    @property
    def rest(self) -> tuple[Node, ...]:
        """What follows the first expression of a list."""
        return self.items[1:]

    def with_words(self, words: Mapping[str, Node]) -> Node:
        """Return the expression with other expressions in the place of some words."""
        if self.word:
            return words.get(self.word, self)
        return replace(self, items=tuple(each.with_words(words) for each in self.items))

    def __str__(self) -> str:
        return self.written or f"({' '.join(map(str, self.items))})"


@dataclass(slots=True)
class Findings:
    """What is found on the way: errors of the files, and what the language cannot say."""

    diagnostics: list[Diagnostic] = field(default_factory=list)

    def add_error(self, error: BrokenPddl) -> None:
        """Note an error of a file."""
        self.diagnostics.append(Diagnostic("broken-pddl", error.node.span, str(error), error.help))

    def add_missing(self, missing: Missing) -> str:
        """Note what is not in the library, and return the comment that stands in its place."""
        self.diagnostics.append(Diagnostic("not-imported", missing.node.span, str(missing), severity="warning"))
        shown = str(missing.node)
        return f"# not imported: {shown if len(shown) <= 90 else shown[:87] + '...'}"

    def sorted(self) -> tuple[Diagnostic, ...]:
        """Return what was found, in the order of the text."""
        return tuple(sorted(self.diagnostics, key=lambda each: each.span))

    @property
    def is_broken(self) -> bool:
        """Whether there is an error."""
        return any(each.severity == "error" for each in self.diagnostics)


def parse_expressions(source: Source) -> tuple[Node, ...]:
    """Return the expressions of a file; BrokenPddl if parentheses do not match."""
    open_: list[tuple[Node, list[Node]]] = []
    done: list[Node] = []
    for word in _list_words(source):
        if word.word == "(":
            if len(open_) == MOST_DEPTH:
                raise BrokenPddl(word, f"this is nested deeper than {MOST_DEPTH} levels")
            open_.append((word, []))
            continue
        if word.word == ")":
            if not open_:
                raise BrokenPddl(word, "this `)` closes nothing", "remove it")
            begun, items = open_.pop()
            word = Node(begun.span.to(word.span), items=tuple(items))
        (open_[-1][1] if open_ else done).append(word)
    if open_:
        raise BrokenPddl(open_[-1][0], "this `(` is never closed", "write its `)`")
    return tuple(done)


def _list_words(source: Source) -> Iterator[Node]:
    """Yield the words and parentheses of a file, without spaces and comments."""
    line, start = 1, 0
    for found in _TOKEN.finditer(source.text):
        text = found.group()
        if text == "\n":
            line, start = line + 1, found.end()
        elif not text.isspace() and text[0] != ";":
            yield _word(source, line, found.start() - start + 1, text)


def _word(source: Source, line: int, column: int, text: str) -> Node:
    return Node(Span(source.path, line, column, line, column + len(text)), text.lower(), text)


def refuse(node: Node, message: str, help_: str = "") -> NoReturn:
    """Raise BrokenPddl."""
    raise BrokenPddl(node, message, help_)
