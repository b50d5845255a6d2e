"""Documents for expressions, conditions, calls and lists: on one line if they fit, otherwise broken."""

from __future__ import annotations

import re
from collections.abc import Sequence

from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.notes import Notes
from skillc_dsl.parsing.tokens import Branch, Token, Tree
from skillc_dsl.token_table import NUMBER

_CHAINS = ("sum", "product", "or_", "and_", "implies")
_TIGHT = ("member", "negative", "opposite", "list_of", "implementation")
_CALLS = ("call", "apply", "check")


def is_token(branch: Branch, kind: str) -> bool:
    """Whether a branch is a token of the given kind."""
    return isinstance(branch, Token) and branch.type == kind


def index_of(children: Sequence[Branch], kind: str) -> int:
    """Return the index of the first token of the given kind in `children`, or -1."""
    return next((index for index, child in enumerate(children) if is_token(child, kind)), -1)


class InlineFormatter:
    """Creates the documents of all constructs without braces."""

    def __init__(self, notes: Notes) -> None:
        self.notes = notes

    def of(self, branch: Branch) -> d.Document:
        """Return the document of a token or a tree."""
        if isinstance(branch, Token):
            return d.concatenate(self.notes.above(branch), self.bare(branch))
        children = branch.children
        if branch.data in _CHAINS:
            return self._chain(branch)
        if branch.data in _TIGHT:
            return self.tight(children)
        if branch.data in _CALLS:
            return self._call(children)
        if branch.data == "aggregate":
            return self._aggregate(children)
        if branch.data in ("parentheses", "list_value"):
            return self.bracketed(children)
        if branch.data in ("quantified", "something"):
            start = index_of(children, "LPAR")
            return d.concatenate(self.spaced(children[:start]), d.Gap(), self.bracketed(children[start:]))
        return self.spaced(children)

    def bare(self, token: Token) -> d.Document:
        """Return a token without the comments above it; a quantity is written with one space before its unit."""
        number = re.match(NUMBER, token) if token.type == "QUANTITY" else None
        text = f"{number.group()} {token[number.end() :].strip()}" if number else token.value
        return d.concatenate(d.Fragment(text), self.notes.behind(token))

    def tight(self, children: Sequence[Branch]) -> d.Document:
        """Return the parts without spaces between them."""
        return d.Concatenation(tuple(self.of(child) for child in children))

    def spaced(self, children: Sequence[Branch]) -> d.Document:
        """Return the parts with spaces between them; a list that does not fit its line breaks after each comma."""
        first, *others = children
        gap: d.Document = d.Gap()
        parts: list[d.Document] = [self.bare(first) if isinstance(first, Token) else self.of(first)]
        for child in others:
            if isinstance(child, Token) and child.type == "COMMA":
                parts.append(self.comma(child))
                gap = d.SoftBreak()
            else:
                parts += [gap, self.of(child)]
                gap = d.Gap()
        above = self.notes.above(first) if isinstance(first, Token) else d.NOTHING
        listed = index_of(children, "COMMA") >= 0
        line = d.Concatenation(tuple(parts))
        return d.concatenate(above, d.DocumentGroup(d.Indent(line)) if listed else line)

    def bracketed(self, children: Sequence[Branch], end: str = "") -> d.Document:
        """Return brackets with their content, which is put on separate lines if it does not fit one.

        `end` is the text after the last part if the brackets break, such as a trailing comma.
        """
        opening, *inner, closing = children
        parts: list[d.Document] = [d.SoftBreak("")]
        for index, child in enumerate(inner):
            if isinstance(child, Token) and child.type == "COMMA":
                last = index == len(inner) - 1
                parts.append(self.comma(child, d.WhenBroken(end) if last else d.Punctuation(",")))
                parts += [] if last else [d.SoftBreak()]
            else:
                parts.append(self.of(child))
        if inner and end and not is_token(inner[-1], "COMMA"):
            parts.append(d.WhenBroken(end))
        if not isinstance(closing, Token):
            raise TypeError(f"a bracket was expected, not {closing!r}")
        body = d.Indent(d.concatenate(*parts, self.above_closing(closing)))
        return d.DocumentGroup(d.concatenate(self.of(opening), body, d.SoftBreak(""), self.bare(closing)))

    def above_closing(self, token: Token) -> d.Document:
        """Return the comments above a closing bracket or brace, each on its own line."""
        notes = self.notes.above(token)
        return notes if notes == d.NOTHING else d.concatenate(d.HardBreak(), notes)

    def comma(self, token: Token, mark: d.Document | None = None) -> d.Document:
        """Return a comma with its comments."""
        return d.concatenate(mark or d.Punctuation(","), self.notes.behind(token))

    def _chain(self, tree: Tree) -> d.Document:
        """Return a chain of operands and operators; if it does not fit one line, each operator begins a new line."""
        first, *rest = self._links(tree)
        parts: list[d.Document] = []
        for operator, operand in zip(rest[::2], rest[1::2], strict=True):
            parts += [d.SoftBreak(), self.of(operator), d.Gap(), self.of(operand)]
        return d.DocumentGroup(d.concatenate(self.of(first), d.Indent(d.Concatenation(tuple(parts)))))

    def _links(self, tree: Tree) -> list[Branch]:
        """Return operands and operators in order, with a chain on the left flattened into this one."""
        links: list[Branch] = list(tree.children)
        while isinstance(links[0], Tree) and links[0].data == tree.data and tree.data in ("sum", "product"):
            links[:1] = links[0].children
        return links

    def _call(self, children: Sequence[Branch]) -> d.Document:
        """Return `Name[implementation](argument, ..) -> out`; a function call in a value has no trailing comma."""
        start, end = index_of(children, "LPAR"), index_of(children, "RPAR")
        is_step = isinstance(children[0], Tree) and children[0].data == "callee"
        head = self.tight(children[:start])
        brackets = self.bracketed(children[start : end + 1], "," if is_step else "")
        tail = [part for child in children[end + 1 :] for part in (d.Gap(), self.of(child))]
        return d.concatenate(head, brackets, *tail)

    def _aggregate(self, children: Sequence[Branch]) -> d.Document:
        """Return `name(x: Class where C, value)`."""
        function, opening, *inner, closing = children
        end = index_of(inner, "COMMA")
        members, value = (inner, []) if end < 0 else (inner[:end], inner[end:])
        brackets = self.bracketed((opening, Tree("members", members), *value, closing))
        return d.concatenate(self.of(function), brackets)
