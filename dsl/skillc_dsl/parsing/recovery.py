"""The parser loop with error recovery: it continues after each syntax error and keeps what was parsed before it."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, ForeignForm, Label, Misfit
from skillc_dsl.parsing.automaton import MisfitError, Parser
from skillc_dsl.parsing.constructs import show_construct
from skillc_dsl.parsing.expectations import describe_terminals, describe_token, explain_where_it_belongs
from skillc_dsl.parsing.foreign.matching import report_foreign_form
from skillc_dsl.parsing.grammar import DECLARATIONS, END, begins_line, can_continue, list_fitting_terminals
from skillc_dsl.parsing.lexer import empty_token_after, token_span
from skillc_dsl.parsing.nesting import DEEPEST, report_too_deep
from skillc_dsl.parsing.repairs import Fault, repair
from skillc_dsl.parsing.reserved import report_reserved
from skillc_dsl.parsing.reserved_names import declared_words
from skillc_dsl.parsing.second_step import report_second_step
from skillc_dsl.parsing.token_repairs import join_tokens
from skillc_dsl.parsing.tokens import Branch, Token, Tree, tokens_in
from skillc_dsl.source import Source, Span

_LISTS = ("__start_star", "__skill_star", "__impl_star", "__task_star", "__test_star", "___nodes_star")
_MOST_STATES = 10 * DEEPEST
"""The maximum size of the parser stack, which bounds the time of recovery."""
MOST_FAULTS = 200
"""The number of syntax errors after which the rest of a file is not parsed."""
_CALM = 2
"""The number of tokens that must fit after a syntax error before the next one is reported."""


class Recovery:
    """One run over a copy of the tokens of `source`, which repairs change; lines in `reported` already have a problem.

    `errors` are the places where tokens were dropped; `foreign` has the reported forms of other languages, each with
    the place from it to where parsing goes on.
    """

    def __init__(self, tokens: Sequence[Token], source: Source, reported: Collection[int]) -> None:
        self.tokens = list(tokens)
        self.path = source.path
        self._lines = source.text.split("\n")
        self.reported = reported
        self.problems: list[Diagnostic] = []
        self.errors: list[s.ErrorNode] = []
        self.foreign: list[tuple[ForeignForm, Span]] = []
        self._dropped: list[Token] = []
        self._parser: Parser[Tree] = Parser(Tree)
        self._since = _CALM
        self._faults = 0
        self._words = declared_words(tokens, source.edition)

    def run(self) -> Tree:
        """Return the parse tree of everything that was parsed."""
        index, feed = 0, self._parser.feed
        while self.tokens[index].type != END or not can_continue(self._parser.states, END):
            before = self._parser.states.copy()
            if len(before) > _MOST_STATES:
                index = self._leave_too_deep(index)
                continue
            self._read_reserved_as_relation(index)
            try:
                feed(self.tokens[index])
                self._since = 0 if _is_inserted(self.tokens[index]) else self._since + _is_written(self.tokens[index])
                index += 1
            except MisfitError:
                index = self._recover(before, index)
        tree = self._parser.finish(self.tokens[index])
        assert isinstance(tree, Tree)
        return tree

    def _recover(self, before: list[int], index: int) -> int:
        """Report the fault at `index` and return the index to continue at."""
        if self._reads_declared_word(index):
            return index
        self._faults += 1
        if self._faults > MOST_FAULTS:
            return self._give_up(index)
        if self._leave_unclosed_call(index):
            return index - 1
        fault = Fault(self._parser.states, self.tokens, index, self.path)
        second = report_second_step(before, self._parser.values, self.tokens, index, self.path)
        foreign = report_foreign_form(fault, self._lines) if second is None else None
        found = repair(fault) if foreign is None else None
        if found is not None:
            self._report(found.problem)
            self._leave_error(index, [] if self.tokens[index] in found.tokens else [self.tokens[index]])
            self.tokens[index : index + 1] = found.tokens
            self._since = 0
            return index
        misfit = second or foreign or self._misfit(before, index)
        may_follow = not isinstance(misfit, ForeignForm) and misfit.span.line in self.reported
        is_new = not may_follow and self._report(misfit)
        position = self._resume(index)
        if is_new and isinstance(misfit, ForeignForm):
            self.foreign.append((misfit, self._place_to(misfit.span, position)))
        self._leave_error(index, self.tokens[index:position])
        self._since = _CALM if begins_line(self.tokens, position) else 0
        return position

    def _place_to(self, start: Span, position: int) -> Span:
        """Return the place from `start` to the token at `position`, or to the end of the text."""
        if self.tokens[position].type == END:
            return Span(self.path, start.line, start.column, len(self._lines) + 1, 1)
        end = token_span(self.tokens[position], self.path)
        return Span(self.path, start.line, start.column, end.line, end.column)

    def _reads_declared_word(self, index: int) -> bool:
        """Whether a word of the language is the name of something, which was reported; it is read as that name."""
        token = self.tokens[index]
        if token.type == "NAME" or token.value not in self._words or not can_continue(self._parser.states, "NAME"):
            return False
        self.tokens[index] = join_tokens("NAME", token, token, token.value)
        return True

    def _leave_unclosed_call(self, index: int) -> bool:
        """Report a call whose `)` is missing if the next one begins on a line of its own; whether it is so."""
        values = self._parser.values
        start = next((at for at in range(len(values), 0, -1) if _is_list(values[at - 1])), 0)
        opened = [value for value in values[start:] if isinstance(value, Token) and value.type == "LPAR"]
        begins = index > 1 and self.tokens[index - 1].type == "NAME" and begins_line(self.tokens, index - 1)
        if not opened or not begins or self.tokens[index].type != "LPAR" or not self._cut(index - 1):
            return False
        last = self.tokens[index - 2]
        label = Label(token_span(opened[-1], self.path), "opened here")
        message = f"the call goes on after {describe_token(last)}, or its `)` is missing"
        help_ = "write the next argument, or `)`"
        self._report(Diagnostic("syntax", token_span(last, self.path), message, help_, labels=(label,)))
        self._leave_error(index - 1, [])
        self._since = _CALM
        return True

    def _read_reserved_as_relation(self, index: int) -> None:
        """Report a relation that is called like a word of the language, and let it be parsed as a relation."""
        token = self.tokens[index]
        problem = report_reserved(self._parser.states, self.tokens, index, self.path)
        if problem is not None:
            self._report(problem)
        if problem is not None or (token.type in ("HAS", "IS") and self._words.get(token.value) == "relation"):
            self.tokens[index] = join_tokens("NAME", token, token, token.value)

    def _leave_too_deep(self, index: int) -> int:
        """Report text that is nested too deep; return the index of the next declaration or of the end."""
        self.problems.append(report_too_deep(token_span(self.tokens[index], self.path)))
        last = len(self.tokens) - 1
        begins = (at for at in range(index, last) if self.tokens[at].type in DECLARATIONS)
        position = next((at for at in begins if begins_line(self.tokens, at)), last)
        self._drop_member(self._level(self.tokens[position].type) or 0)
        self._close(self.tokens[position].type)
        self._leave_error(index, self.tokens[index:position])
        return position

    def _drop_member(self, outer: int) -> None:
        """Drop the unfinished member of the declaration that begins at the level `outer`."""
        states, values = self._parser.states, self._parser.values
        levels = (level for level in range(outer + 1, len(values)) if _is_list(values[level - 1]))
        level = next((level for level in levels if can_continue(states[: level + 1], "RBRACE")), None)
        if level is not None:
            self._drop(level)

    def _give_up(self, index: int) -> int:
        """Report that the rest of the file is not parsed; return the index of the end."""
        span = token_span(self.tokens[index], self.path)
        help_ = "correct the errors above first; if there are none to see, this is not a file of skills"
        message = f"this file has more than {MOST_FAULTS} syntax errors; the rest is not read"
        self.problems.append(Diagnostic("syntax", span, message, help_))
        self._close(END)
        return len(self.tokens) - 1

    def _report(self, problem: Diagnostic) -> bool:
        """Add `problem` unless it probably follows from the last one, on the same line or a few tokens before.

        Whether it was added.
        """
        is_new = self._since >= _CALM and all(problem.span.line != other.span.line for other in self.problems[-1:])
        if is_new:
            self.problems.append(problem)
        return is_new

    def _misfit(self, before: list[int], index: int) -> Diagnostic:
        """Return the diagnostic with the found and the expected tokens; an incomplete member is reported at its end."""
        token, expected = self.tokens[index], list_fitting_terminals(before)
        span = token_span(token, self.path)
        if token.type == "RBRACE" and END in expected:
            return Diagnostic("unopened-brace", span, "this `}` closes nothing", "delete it, or add the `{` before it")
        found = f"{describe_token(token)} does not fit here"
        begins = begins_line(self.tokens, index)
        complete = begins and bool(expected & {"RBRACE", END})
        if index and begins and not complete:
            last = self.tokens[index - 1]
            span, found = token_span(last, self.path), f"something is missing after {describe_token(last)}"
        home = explain_where_it_belongs(token) if "RBRACE" in expected else ""
        help_ = home or ("" if complete else show_construct(self._parser.values))
        message = f"{found}: expected {describe_terminals(expected)}"
        return Misfit("syntax", span, message, help_, found=found, could_end="RBRACE" in expected)

    def _resume(self, index: int) -> int:
        """Drop the incomplete part; return the index of the next start or end of a member, node or declaration."""
        depth = 0
        for position in range(index, len(self.tokens)):
            token = self.tokens[position]
            begins = begins_line(self.tokens, position)
            if token.type == END or (token.type in DECLARATIONS and begins):
                self._close(token.type)
                return position
            if depth == 0 and (begins or token.type == "RBRACE") and self._cut(position):
                return position
            depth = max(0, depth + (token.type == "LBRACE") - (token.type == "RBRACE"))
        raise AssertionError("the last token is the end")

    def _cut(self, position: int) -> bool:
        """Drop the incomplete member if the token at `position` can follow; after a name the next one must fit too."""
        is_name = self.tokens[position].type in ("NAME", "QNAME") and not begins_line(self.tokens, position + 1)
        count = 2 if is_name else 1
        following = [token.type for token in self.tokens[position : position + count]]
        level = self._level("RBRACE")
        if level is None or not can_continue(self._parser.states[: level + 1], *following):
            return False
        self._drop(level)
        return True

    def _close(self, terminal: str) -> None:
        """Close all open declarations, so that `terminal` fits at the top level of the file."""
        outer = self._level(terminal) or 0
        inner = self._level("RBRACE")
        while inner is not None and inner > outer:
            self._drop(inner)
            self._parser.feed(empty_token_after(self._last(), "RBRACE"))
            outer, inner = self._level(terminal) or 0, self._level("RBRACE")
        self._drop(outer)

    def _last(self) -> Token:
        """Return the last token that was parsed."""
        last: Branch = self._parser.values[-1]
        while isinstance(last, Tree):
            last = last.children[-1]
        return last

    def _level(self, terminal: str) -> int | None:
        """Return the size of the stack at which `terminal` fits after a complete member or at the start, or None.

        The stack is never cut between a pair of braces.
        """
        states, values = self._parser.states, self._parser.values
        closed = 0
        for level in range(len(values), -1, -1):
            closed = max(0, closed + _braces(values[level : level + 1]))
            at_member = closed == 0 and (level == 0 or _is_list(values[level - 1]))
            if at_member and can_continue(states[: level + 1], terminal):
                return level
        return None

    def _leave_error(self, index: int, skipped: Sequence[Token]) -> None:
        """Record the error at `index`, with the names in the tokens that were dropped or skipped."""
        tokens = (*self._dropped, *skipped)
        words = (str(token).rstrip(":") for token in tokens)
        names = frozenset(word for word in words if word.replace(":", "_").isidentifier())
        span = token_span(self.tokens[index], self.path)
        here = [at for at, token in enumerate(tokens) if token.type in DECLARATIONS and token.line == span.line]
        keyword, name = (*map(str, tokens[here[-1] :][:2]), "")[:2] if here else ("", "")
        self.errors.append(s.ErrorNode(span, names, keyword, name))
        self._dropped.clear()

    def _drop(self, level: int) -> None:
        self._dropped += tokens_in(self._parser.cut(level))


def _braces(values: Sequence[object]) -> int:
    """Return the number of `}` minus the number of `{` in `values`."""
    kinds = [value.type for value in values if isinstance(value, Token)]
    return kinds.count("RBRACE") - kinds.count("LBRACE")


def _is_inserted(token: Token) -> bool:
    """Whether a token is a `}` that was inserted by a repair."""
    return token.type == "RBRACE" and not token


def _is_written(token: Token) -> bool:
    """Whether a token stands in the text, so that it was not inserted by a repair."""
    return token.start_pos is not None


def _is_list(value: object) -> bool:
    """Whether `value` is a `{`, the list of members after it, or the closing `}`."""
    if isinstance(value, Token):
        return value.type in ("LBRACE", "RBRACE")
    return isinstance(value, Tree) and value.data.startswith(_LISTS)
