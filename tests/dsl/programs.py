"""Programs made from the grammar: any tokens that it derives, with any blanks and comments between them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from hypothesis import strategies as st
from lark.grammar import NonTerminal, Rule
from lark_peer import load_parser

from skillc_dsl.parsing.grammar import fixed_texts

WRITTEN: dict[str, list[str]] = {
    "NAME": ["arm", "surface", "Pick", "größe", "an_even_longer_name_of_something"],
    "QNAME": ["lab:Board-1", "skiros:contain"],
    "LABEL": ["arm:", "speed:", "a_longer_label:"],
    "NUMBER": ["2", "0.50", "1e-3"],
    "QUANTITY": ["8 N", "0.25m/s", "90 \tdeg", "1e2 Nm/rad"],
    "STRING": ['"scenes/a # b.ttl"', '""'],
    "IRI": ["<http://example.org/lab#>"],
}
BLANKS = st.sampled_from([" ", "  ", "\n", "\n\n", "\n \n\n", "\t", "\r\n"])
COMMENTS = st.sampled_from(["# why", "## what it is", "#", "# {", "#> no `{` ends # here  "])


@cache
def rules() -> dict[str, list[Rule]]:
    """The productions of each symbol."""
    found: dict[str, list[Rule]] = {}
    for rule in load_parser().rules:
        found.setdefault(rule.origin.name, []).append(rule)
    return found


@cache
def heights() -> dict[str, float]:
    """How deep the flattest derivation of each symbol is."""
    known = dict.fromkeys(rules(), float("inf"))
    for _ in known:
        for symbol, productions in rules().items():
            known[symbol] = min(height(rule, known) for rule in productions)
    return known


def height(rule: Rule, known: dict[str, float]) -> float:
    return 1 + max((known.get(symbol.name, 0) for symbol in rule.expansion), default=0)


def derive(draw: Callable[[st.SearchStrategy[int]], int], symbol: str, budget: list[int], tokens: list[str]) -> None:
    """Append the terminals of a random derivation; the flattest one once the budget is used up."""
    productions = rules()[symbol]
    budget[0] -= 1
    if budget[0] < 0:
        rule = min(productions, key=lambda rule: height(rule, heights()))
    else:
        longer = 3 * [rule for rule in productions if NonTerminal(symbol) in rule.expansion]
        choices = productions + longer
        rule = choices[draw(st.integers(0, len(choices) - 1))]
    for part in rule.expansion:
        if isinstance(part, NonTerminal):
            derive(draw, part.name, budget, tokens)
        else:
            tokens.append(part.name)


@st.composite
def programs(draw: st.DrawFn) -> str:
    """A text of the language, as wild as its blanks may be."""
    tokens: list[str] = []
    derive(draw, "start", [draw(st.integers(20, 300))], tokens)
    text = draw(gaps)
    for terminal in tokens:
        written = draw(st.sampled_from(WRITTEN[terminal])) if terminal in WRITTEN else fixed_texts()[terminal]
        text += written + draw(gaps)
    return text


gaps = st.one_of(
    st.just(" "),
    st.just(" "),
    st.just("\n"),
    st.lists(st.tuples(BLANKS, COMMENTS, st.just("\n")).map("".join), min_size=1, max_size=2).map("".join),
    BLANKS,
)
