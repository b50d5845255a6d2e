"""Steps of a body as documents: what braces hold."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token, Tree

from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.inline import Branch, Inline, index_of, is_token

_SHORT = ("call", "wait", "wait_until", "check", "apply_posts")


class Steps(Inline):
    """Makes documents of steps, each on its line."""

    def step(self, tree: Branch) -> d.Document:
        """Return a step with the steps in its braces."""
        if not isinstance(tree, Tree):
            raise TypeError(f"a step was expected, not {tree!r}")
        if tree.data == "if_":
            return self._if(tree.children)
        start = index_of(tree.children, "LBRACE")
        if start < 0:
            return self.of(tree)
        return d.joined(self.spaced(tree.children[:start]), self._braces(tree.children[start:]))

    def _if(self, children: Sequence[Branch]) -> d.Document:
        """Return `if C { }`, `else { }` on the line of the `}` before it."""
        head = self.spaced(children[:2])
        parts: list[d.Document] = [self._braces(_inside(children[2]))]
        for child in children[3:]:
            word, *rest = _inside(child)
            free = self._is_free(_inside(children[2])[-1], word)
            parts += [d.Space() if free else d.NewLine(), self.of(word)]
            parts += [d.Space(), self.step(rest[0])] if isinstance(rest[0], Tree) else [self._braces(rest)]
        return d.joined(head, *parts)

    def opening(self, brace: Token) -> d.Document:
        """Return an opening brace, which stays on the line of what it follows."""
        return d.joined(d.Mark(" {"), self.notes.above(brace), self.notes.behind(brace))

    def _is_free(self, closing: Branch, word: Branch) -> bool:
        """Whether no comment stands between a `}` and the `else` after it."""
        behind = self.notes.behind(closing) if isinstance(closing, Token) else d.NOTHING
        above = self.notes.above(word) if isinstance(word, Token) else d.NOTHING
        return behind == above == d.NOTHING

    def _braces(self, children: Sequence[Branch]) -> d.Document:
        """Return a block: its steps on lines of their own, but one short step stays on the line where it is written."""
        opening, *steps, closing = children
        if not isinstance(opening, Token) or not isinstance(closing, Token):
            raise TypeError(f"braces were expected, not {children!r}")
        bare = self.notes.behind(opening) == self.notes.above(closing) == d.NOTHING
        if bare and not steps:
            return d.joined(d.Mark(" {"), d.Space(), self.bare(closing))
        short = all(isinstance(step, Tree) and step.data in _SHORT for step in steps)
        if bare and len(steps) == 1 and short and opening.line == closing.line:
            body = d.Nest(d.joined(d.Line(), self.of(steps[0])))
            return d.Group(d.joined(self.opening(opening), body, d.Line(), self.bare(closing)))
        lines = (part for step in steps for part in (d.NewLine(), self.step(step)))
        body = d.Nest(d.joined(*lines, self.above_closing(closing)))
        return d.joined(self.opening(opening), body, d.NewLine(), self.bare(closing))


def _inside(branch: Branch) -> list[Branch]:
    """Return the parts of a tree."""
    return list(branch.children) if isinstance(branch, Tree) else [branch]


def has_braces(branch: Branch) -> bool:
    """Whether a step holds others."""
    return isinstance(branch, Tree) and (branch.data == "if_" or any(is_token(c, "LBRACE") for c in branch.children))
