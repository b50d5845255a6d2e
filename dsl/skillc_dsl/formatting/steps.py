"""Documents for the steps of a body and their blocks in braces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.inline import InlineFormatter, index_of, is_token
from skillc_dsl.parsing.tokens import Branch, Token, Tree

_SHORT = ("call", "wait", "wait_until", "check", "fail", "apply_posts")


class StepFormatter(InlineFormatter):
    """Creates the documents of steps, each on its own line."""

    def step(self, tree: Branch) -> d.Document:
        """Return a step with the steps in its braces."""
        if not isinstance(tree, Tree):
            raise TypeError(f"a step was expected, not {tree!r}")
        if tree.data == "if_":
            return self._if(tree.children, all(self._is_short(block) for block in _blocks(tree)))
        start = index_of(tree.children, "LBRACE")
        if start < 0:
            return self.of(tree)
        end = index_of(tree.children, "RBRACE") + 1
        block, further = tree.children[start:end], tree.children[end:]
        head = self.spaced(tree.children[:start])
        if not further:
            return d.concatenate(head, self._braces(block, self._is_short(block)))
        return d.concatenate(head, self._braces(block, False), *self.further(block[-1], further))

    def further(self, before: Branch, blocks: Sequence[Branch]) -> Iterator[d.Document]:
        """Yield `on failure as why { }` and `finally { }`, each on the line on which the step before it ends."""
        closing = _last(before)
        for block in blocks:
            children = _inside(block)
            start = index_of(children, "LBRACE")
            yield d.Gap() if self._is_free(closing, children[0]) else d.HardBreak()
            yield self.spaced(children[:start])
            yield self._braces(children[start:], False)
            closing = children[-1]

    def _if(self, children: Sequence[Branch], short: bool) -> d.Document:
        """Return `if C { } else { }`, with `else` on the line of the preceding `}`; `short` applies to all blocks."""
        then = _inside(children[2])
        parts: list[d.Document] = [self.spaced(children[:2]), self._braces(then, short)]
        for child in children[3:]:
            word, *rest = _inside(child)
            parts += [d.Gap() if self._is_free(then[-1], word) else d.HardBreak(), self.of(word)]
            further = isinstance(rest[0], Tree)
            parts += [d.Gap(), self._if(_inside(rest[0]), short)] if further else [self._braces(rest, short)]
        return d.Concatenation(tuple(parts))

    def opening(self, brace: Token) -> d.Document:
        """Return an opening brace, which stays on the line of the preceding text."""
        return d.concatenate(d.Punctuation(" {"), self.notes.behind(brace))

    def _is_free(self, closing: Branch, word: Branch) -> bool:
        """Whether there is no comment between a `}` and the `else` after it."""
        behind = self.notes.behind(closing) if isinstance(closing, Token) else d.NOTHING
        above = self.notes.above(word) if isinstance(word, Token) else d.NOTHING
        return behind == above == d.NOTHING

    def _is_short(self, block: Sequence[Branch]) -> bool:
        """Whether a block is empty, or has one short step that is written on the line of the braces."""
        opening, *steps, closing = block
        if not isinstance(opening, Token) or not isinstance(closing, Token):
            raise TypeError(f"braces were expected, not {block!r}")
        bare = self.notes.behind(opening) == self.notes.above(closing) == d.NOTHING
        plain = all(isinstance(step, Tree) and step.data in _SHORT and self._is_bare(step) for step in steps)
        return bare and (not steps or (len(steps) == 1 and plain and opening.line == closing.line))

    def _is_bare(self, step: Branch) -> bool:
        """Whether a step has no comments."""
        return not any(isinstance(leaf, d.CommentLine | d.TrailingComment) for leaf in d.leaves(self.of(step)))

    def _braces(self, block: Sequence[Branch], short: bool) -> d.Document:
        """Return a block on one line if it is `short` and fits, otherwise with a line for each step."""
        opening, *steps, closing = block
        if not isinstance(opening, Token) or not isinstance(closing, Token):
            raise TypeError(f"braces were expected, not {block!r}")
        if not steps and self._is_short(block):
            return d.concatenate(self.opening(opening), d.Gap(), self.bare(closing))
        gap = d.SoftBreak() if short else d.HardBreak()
        lines = (part for step in steps for part in (gap, self.step(step)))
        body = d.Indent(d.concatenate(*lines, self.above_closing(closing)))
        whole = d.concatenate(self.opening(opening), body, gap, self.bare(closing))
        return d.DocumentGroup(whole) if short else whole


def _blocks(tree: Tree) -> Iterator[Sequence[Branch]]:
    """Yield the blocks of an `if` and of every `else`, from `{` to `}`."""
    _, _, then, *orelse = tree.children
    yield _inside(then)
    for _, first, *rest in map(_inside, orelse):
        if isinstance(first, Tree):
            yield from _blocks(first)
        else:
            yield [first, *rest]


def _inside(branch: Branch) -> list[Branch]:
    """Return the parts of a tree."""
    return list(branch.children) if isinstance(branch, Tree) else [branch]


def _last(branch: Branch) -> Branch:
    """Return the last token of a tree."""
    while isinstance(branch, Tree):
        branch = branch.children[-1]
    return branch


def has_braces(branch: Branch) -> bool:
    """Whether a step holds others."""
    return isinstance(branch, Tree) and (branch.data == "if_" or any(is_token(c, "LBRACE") for c in branch.children))
