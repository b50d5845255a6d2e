"""Reports and repairs mistakes in adjacent tokens before parsing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.prefix_repairs import count_prefix_mistake, repair_prefix
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Span
from skillc_dsl.units import UNITS, suggest_units

MEANT: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "=<": ("LESS_EQUAL", "<="),
        "===": ("EQUALS", "=="),
        "<>": ("UNEQUAL", "!="),
    }
)
"""Comparisons of other languages, with the terminal and text to use instead."""


NAMELESS = "a name of a vocabulary has a prefix before its `:`"
"""Said once: who writes one such name writes all of them so."""
_COUNTED = frozenset(("RETRY", "REPEAT", "MAX"))
"""What a number without a unit follows."""
_BEFORE_RELATIONS = frozenset(("NAME", "QNAME", "STRING"))
"""What stands before the name of a relation, and of no parameter."""
_NO_VALUES = frozenset(("COLON", "COMMA", "RPAR", "RBRACE", "RSQB"))


def repair_tokens(tokens: tuple[Token, ...], path: str) -> Outcome[tuple[Token, ...]]:
    """Return the tokens with units, operators, braces, labels and words that begin declarations repaired."""
    repaired: list[Token] = []
    problems: list[Diagnostic] = []
    index = 0
    while index < len(tokens):
        count, token, problem = _repaired(tokens, index, path)
        repaired.append(token)
        if problem and not (problem.message == NAMELESS and any(each.message == NAMELESS for each in problems)):
            problems.append(problem)
        index += count
    return Outcome(tuple(repaired), tuple(problems))


def has_unknown_unit(tokens: tuple[Token, ...]) -> bool:
    """Whether there is a number with an unknown unit, the one mistake in tokens that the grammar may not show."""
    numbers = (at for at, token in enumerate(tokens) if token.type in ("QUANTITY", "NUMBER"))
    return any(_unit_length(tokens, at) for at in numbers)


def _repaired(tokens: tuple[Token, ...], index: int, path: str) -> tuple[int, Token, Diagnostic | None]:
    """Return the number of tokens from `index` to replace, the token that replaces them, and the problem, if any."""
    if count := match_foreign_comparison(tokens, index):
        return count, *repair_comparison(tokens[index : index + count], path)
    if count := _unit_length(tokens, index):
        return count, *_unit(tokens[index : index + count], path)
    if _is_doubled_brace(tokens, index):
        return 2, tokens[index], _doubled(tokens[index + 1], path)
    if _begins_implementation(tokens, index):
        return 1, *_implementation(tokens[index], path)
    if _is_assigned_argument(tokens, index):
        return 2, *_assigned_argument(tokens[index], tokens[index + 1], tokens[index + 2], path)
    if count := count_prefix_mistake(tokens, index):
        return count, *repair_prefix(tokens, index, count, path)
    if _is_nameless_prefix(tokens, index):
        return 2, *_nameless_prefix(tokens[index], tokens[index + 1], path)
    if _is_split_label(tokens, index):
        return 2, *_label(tokens[index], tokens[index + 1], tokens[index + 2], path)
    return 1, tokens[index], None


def join_tokens(kind: str, first: Token, last: Token, text: str) -> Token:
    """Return one token that replaces the tokens from `first` to `last`."""
    end = (last.end_line, last.end_column, last.end_pos)
    return Token(kind, text, first.start_pos, first.line, first.column, *end)


def _touch(left: Token, right: Token) -> bool:
    return left.end_pos == right.start_pos


def _unit_length(tokens: tuple[Token, ...], index: int) -> int:
    """Return how many tokens from `index` form a number with an unknown unit, or 0.

    Examples are `5 furlong`, `5 km/h`, and `5 N/mm`, which is tokenized as the quantity `5 N` divided by `mm`.
    """
    if tokens[index].type not in ("QUANTITY", "NUMBER") or tokens[index - 1].type in _COUNTED:
        return 0
    first, second, third, fourth = (*tokens[index : index + 4], *(4 * [tokens[-1]]))[:4]
    if first.type == "QUANTITY" and second.type == "SLASH" and _touch(first, second) and _touch(second, third):
        return 3 if third.type == "NAME" and third in UNITS else 0
    if first.type != "NUMBER" or second.type != "NAME" or first.line != second.line:
        return 0
    if third.type in ("LPAR", "LSQB"):
        return 0
    if third.type == "SLASH" and fourth.type == "NAME" and _touch(second, third) and _touch(third, fourth):
        return 4
    return 2


def _unit(tokens: tuple[Token, ...], path: str) -> tuple[Token, Diagnostic]:
    """Return the quantity with the most similar unit, or the bare number if no unit is similar; and the problem."""
    first, last = tokens[0], tokens[-1]
    digits = first.rstrip("/ \t" + "".join(c for c in first if c.isalpha())) if first.type == "QUANTITY" else first
    wrong = (first[len(digits) :] + "".join(tokens[1:])).strip()
    start = token_span(tokens[1], path) if first.type == "NUMBER" else token_span(first, path)
    span = start.to(token_span(last, path))
    near = suggest_units(wrong)
    listed = " or ".join(f"`{unit}`" for unit in near) if near else ", ".join(f"`{unit}`" for unit in UNITS)
    help_ = f"did you mean {listed}?" if near else f"the units are {listed}"
    problem = Diagnostic("unknown-unit", span, f"there is no unit `{wrong}`", help_)
    if near:
        return join_tokens("QUANTITY", first, last, f"{digits} {near[0]}"), problem
    return join_tokens("NUMBER", first, last, str(digits)), problem


def _is_doubled_brace(tokens: tuple[Token, ...], index: int) -> bool:
    """Whether two adjacent `{` are on one line; the grammar never allows that."""
    first = tokens[index]
    if first.type != "LBRACE" or index + 1 == len(tokens):
        return False
    return tokens[index + 1].type == "LBRACE" and first.line == tokens[index + 1].line


def _doubled(brace: Token, path: str) -> Diagnostic:
    span = token_span(brace, path)
    return Diagnostic("syntax", span, "this `{` is one too many", fix=Fix(span, "", "delete it"))


def _begins_implementation(tokens: tuple[Token, ...], index: int) -> bool:
    """Whether a `skill` or `task` at `index` goes on as an implementation does: `skill by_hand of Pick`."""
    if tokens[index].type not in ("SKILL", "TASK"):
        return False
    return [token.type for token in tokens[index + 1 : index + 4]] == ["NAME", "OF", "NAME"]


def _implementation(keyword: Token, path: str) -> tuple[Token, Diagnostic]:
    span = token_span(keyword, path)
    message = f"a {keyword} is not `of` another one; an implementation is"
    fix = Fix(span, "impl", "write `impl`", safe=False)
    return join_tokens("IMPL", keyword, keyword, "impl"), Diagnostic("syntax", span, message, "write `impl`", fix=fix)


def _is_assigned_argument(tokens: tuple[Token, ...], index: int) -> bool:
    """Whether an argument of a call is written as in other languages: `Move(arm, target = place)`."""
    if [token.type for token in tokens[index : index + 2]] != ["NAME", "EQUAL"] or index + 2 == len(tokens):
        return False
    if tokens[index - 1].type not in ("LPAR", "COMMA"):
        return False
    opening = _find_opening(tokens, index - 1)
    called = tokens[opening - 1]
    return opening > 0 and called.type in ("NAME", "RSQB") and _touch(called, tokens[opening])


def _find_opening(tokens: tuple[Token, ...], index: int) -> int:
    """Return the index of the `(` that is open after the token at `index`; 0 if there is none in its block."""
    depth = 0
    for at in range(index, 0, -1):
        kind = tokens[at].type
        if kind in ("LBRACE", "RBRACE"):
            return 0
        if kind == "LPAR" and depth == 0:
            return at
        depth += {"RPAR": 1, "LPAR": -1}.get(kind, 0)
    return 0


def _assigned_argument(name: Token, equal: Token, value: Token, path: str) -> tuple[Token, Diagnostic]:
    span = token_span(name, path).after.to(token_span(equal, path))
    fix = Fix(span, ": " if _touch(equal, value) else ":", f"write `{name}:`")
    problem = Diagnostic("syntax", token_span(equal, path), "an argument is written `name: value`", fix=fix)
    return join_tokens("LABEL", name, equal, f"{name}:"), problem


def _is_split_label(tokens: tuple[Token, ...], index: int) -> bool:
    """Whether a word and a `:` at `index` do not form a label, as in `speed:0.5 m/s` or `arm : ArmDevice`."""
    if index + 2 >= len(tokens) or tokens[index + 1].type != "COLON":
        return False
    if tokens[index + 2].type == "EQUAL":
        return False
    declares_nameless = tokens[index].type == "PREFIX" and tokens[index + 2].type == "IRI"
    is_nameless = declares_nameless or _is_nameless_prefix(tokens, index + 1)
    return tokens[index].isidentifier() and tokens[index].line == tokens[index + 1].line and not is_nameless


def _is_nameless_prefix(tokens: tuple[Token, ...], index: int) -> bool:
    """Whether a `:` at `index` begins a name as in Turtle, as in `goal :Part-1 restsOn :Table`.

    After the name of a parameter or condition, as in `in arm :Arm` and `Pick(arm :Arm-1)`, it is that of a label.
    """
    if tokens[index].type != "COLON" or not 0 < index < len(tokens) - 1:
        return False
    before, after = tokens[index - 1], tokens[index + 1]
    if _touch(before, tokens[index]) or not _touch(tokens[index], after) or after.type not in ("NAME", "QNAME"):
        return False
    return before.type != "NAME" or tokens[index - 2].type in _BEFORE_RELATIONS


def _nameless_prefix(colon: Token, name: Token, path: str) -> tuple[Token, Diagnostic]:
    span = token_span(colon, path).to(token_span(name, path))
    help_ = f"declare `prefix lab: <..>` with what stands before the names of the scene, and write `lab:{name}`"
    return join_tokens("QNAME", colon, name, f"lab:{name}"), Diagnostic("syntax", span, NAMELESS, help_)


def _label(word: Token, colon: Token, value: Token, path: str) -> tuple[Token, Diagnostic | None]:
    label = join_tokens("LABEL", word, colon, f"{word}:")
    before, after = token_span(word, path), token_span(colon, path)
    if _touch(word, colon):  # what is no value is the parser's to report
        is_value = value.type not in _NO_VALUES and value.line == colon.line
        return label, report_missing_space(before.to(after), value) if is_value else None
    gap = Span(path, before.end_line, before.end_column, after.line, after.column)
    fix = Fix(gap, "", "delete the space")
    return label, Diagnostic("syntax", gap.to(after), f"the `:` stands right after `{word}`", f"`{word}:`", fix=fix)


def report_missing_space(label: Span, value: str) -> Diagnostic:
    """Report that `value` follows a label's `:` without a space."""
    message = f"a space is missing between `:` and `{value}`"
    help_ = "without it, `a:b` reads as the name `b` of the vocabulary `a`"
    return Diagnostic("missing-space-after-colon", label, message, help_, fix=Fix(label.after, " ", "insert a space"))


def match_foreign_comparison(tokens: Sequence[Token], index: int) -> int:
    """Return how many tokens from `index` form a comparison of another language, or 0."""
    first, second = tokens[index], tokens[min(index + 1, len(tokens) - 1)]
    if first in MEANT:
        return 1
    return 2 if first.end_pos == second.start_pos and first + second in MEANT else 0


def repair_comparison(tokens: Sequence[Token], path: str) -> tuple[Token, Diagnostic]:
    """Return the intended comparison operator and the problem."""
    first, last = tokens[0], tokens[-1]
    written = "".join(tokens)
    kind, text = MEANT[written]
    span = token_span(first, path).to(token_span(last, path))
    token = Token(kind, text, first.start_pos, first.line, first.column, last.end_line, last.end_column, last.end_pos)
    fix = Fix(span, text, f"write `{text}`")
    return token, Diagnostic("syntax", span, f"there is no `{written}`", f"did you mean `{text}`?", fix=fix)
