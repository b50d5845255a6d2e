"""The parser that lark makes of the grammar, beside which ours is tested."""

from __future__ import annotations

from functools import cache

from lark import Lark, Token, Tree

from skillc_dsl.parsing import tokens as own
from skillc_dsl.parsing.making import make_parser
from skillc_dsl.parsing.tables import grammar_text


@cache
def load_parser() -> Lark:
    """Return the parser of lark for the language."""
    return make_parser(grammar_text())


def convert(branch: Tree[Token] | Token) -> own.Branch:
    """Return a tree of lark as ours."""
    if isinstance(branch, Tree):
        return own.Tree(str(branch.data), [convert(each) for each in branch.children])
    end = (branch.end_line, branch.end_column, branch.end_pos)
    return own.Token(branch.type, branch.value, branch.start_pos, branch.line, branch.column, *end)


def describe(tree: own.Tree) -> list[tuple[str, str, tuple[int | None, ...]]]:
    """Return the tokens of a tree with all that is known of them."""
    return [
        (each.type, str(each), (each.start_pos, each.line, each.column, each.end_pos, each.end_line, each.end_column))
        for each in tree.tokens()
    ]
