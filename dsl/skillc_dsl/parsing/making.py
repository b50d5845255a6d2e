"""Makes the tables of the parser: lark reads the grammar, checks that it is LALR(1), and computes them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from lark import Lark
from lark.grammar import NonTerminal
from lark.grammar import Rule as LarkRule
from lark.lexer import TerminalDef
from lark.parsers.lalr_analysis import Shift

from skillc_dsl.parsing.table_types import NESTED, WORD, Rule, Tables


def make_parser(grammar: str) -> Lark:
    """Return the parser of lark for a grammar."""
    return Lark(grammar, parser="lalr", lexer="basic", keep_all_tokens=True, maybe_placeholders=False)


def make_tables(grammar: str) -> Tables:
    """Return the tables for a grammar."""
    parser = make_parser(grammar)
    parse = parser.parse_interactive("").parser_state.parse_conf.parse_table
    rules = {rule: number for number, rule in enumerate(parser.rules)}
    states: list[dict[str, int]] = [{} for _ in parse.states]
    for state, actions in parse.states.items():
        for symbol, (action, target) in actions.items():
            states[state][symbol] = target if action is Shift else ~rules[target]
    fixed = {each.name: each.pattern.value for each in parser.terminals if each.pattern.type == "str"}
    word = next(each for each in parser.terminals if each.name == WORD)
    words = {text: name for name, text in fixed.items() if re.fullmatch(word.pattern.to_regexp(), text)}
    return Tables(
        parse.start_states["start"],
        parse.end_states["start"],
        tuple(states),
        tuple(map(_describe, parser.rules)),
        "|".join(_patterns(parser.terminals, set(words.values()))),
        fixed,
        words,
        frozenset(parser.ignore_tokens),
    )


def _describe(rule: LarkRule) -> Rule:
    """Return a rule of lark as its parser applies it; one that begins with `_` lists parts of the one around it."""
    lists = [isinstance(each, NonTerminal) and each.name.startswith("_") for each in rule.expansion]
    spread = [at for at, is_list in enumerate(lists) if is_list]
    replaces_one = rule.options.expand1 and not rule.alias
    name = rule.alias or rule.options.template_source or rule.origin.name
    origin = str(rule.origin.name)
    return Rule(
        origin,
        str(name),
        len(rule.expansion),
        tuple(spread),
        bool(replaces_one),
        origin.startswith("_"),
        name in NESTED,
    )


def _patterns(terminals: Iterable[TerminalDef], words: set[str]) -> Iterator[str]:
    """Yield a group for each terminal, in the order in which the lexer of lark tries them; words are found as names."""

    def order(terminal: TerminalDef) -> tuple[int, int, int, str]:
        pattern = terminal.pattern
        return -terminal.priority, -pattern.max_width, -len(pattern.value), terminal.name

    for each in sorted(terminals, key=order):
        if each.name not in words:
            yield f"(?P<{each.name}>{each.pattern.to_regexp()})"
