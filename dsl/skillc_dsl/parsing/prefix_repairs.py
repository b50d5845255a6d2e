"""Repairs `prefix` lines: without the prefix, every name that has it would be reported."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.parsing.grammar import begins_line
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.tokens import Token

_FORM = "`prefix lab: <http://example.org/lab#>`"


def count_prefix_mistake(tokens: Sequence[Token], index: int) -> int:
    """Return how many tokens from `index` stand where the name or the address of a prefix should, or 0."""
    if index < 1 or begins_line(tokens, index):
        return 0
    if tokens[index].type == "COLON" and tokens[index - 1].type == "PREFIX":
        return 1
    if index < 2 or (tokens[index - 2].type, tokens[index - 1].type) != ("PREFIX", "LABEL"):
        return 0
    end = next(at for at in range(index, len(tokens) + 1) if begins_line(tokens, at))
    return 0 if tokens[index].type == "IRI" else end - index


def repair_prefix(tokens: Sequence[Token], index: int, count: int, path: str) -> tuple[Token, Diagnostic]:
    """Return the intended name or address, and the problem."""
    first, last = tokens[index], tokens[index + count - 1]
    span = token_span(first, path).to(token_span(last, path))
    if first.type == "COLON":
        name, problem = name_prefix(tokens, index, path)
        return Token("LABEL", f"{name}:", first.start_pos, *_place(first)), problem
    is_text = first.type == "STRING" and count == 1
    iri = first[1:-1] if is_text else f"{''.join(tokens[index : index + count])}#"  # a `#` begins a comment here
    address = f"<{iri}>"
    fix = Fix(span, address, f"write `{address}`") if is_text else None
    message = "the address of a prefix stands between `<` and `>`"
    return Token("IRI", address, first.start_pos, *_place(first)), Diagnostic("syntax", span, message, _FORM, fix=fix)


def name_prefix(tokens: Sequence[Token], index: int, path: str) -> tuple[str, Diagnostic]:
    """Return the name that a prefix without one should have, as far as the names in the file show it; and the problem.

    The token at `index` is the one in place of the name.
    """
    token = tokens[index]
    names = list(_undeclared(tokens))
    address = next((each for each in tokens[index : index + 2] if each.type == "IRI"), "")
    name = max(dict.fromkeys(names), key=lambda each: (each in address, names.count(each)), default="")
    span = token_span(token, path)
    left, right = tokens[index - 1], tokens[index + 1]
    if token.type == "COLON":
        place, text = span, f"{_gap(left, token)}{name}:{_gap(token, right)}"
    else:
        place, text = span._replace(end_line=span.line, end_column=span.column), f"{_gap(left, token)}{name}: "
    fix = Fix(place, text, f"write `{name}:`", safe=False) if name else None
    return name, Diagnostic("syntax", span, "the prefix has no name", _FORM, fix=fix)


def _undeclared(tokens: Sequence[Token]) -> Iterator[str]:
    """Yield the prefixes of names that no other line of the file declares or uses."""
    known = {token.rstrip(":") for token, before in zip(tokens[1:], tokens, strict=False) if before.type == "PREFIX"}
    for at in (at for at, token in enumerate(tokens) if token.type == "USE"):
        known |= {token.value for token in tokens[at:] if token.line == tokens[at].line}
    counted = Counter(token.partition(":")[0] for token in tokens if token.type == "QNAME")
    for name, count in counted.items():
        yield from [name] * count if name not in known else ()


def _gap(left: Token, right: Token) -> str:
    """Return the space that is missing between two tokens."""
    return " " if left.end_pos == right.start_pos else ""


def _place(token: Token) -> tuple[int | None, int | None, int | None, int | None, int | None]:
    return token.line, token.column, token.end_line, token.end_column, token.end_pos
