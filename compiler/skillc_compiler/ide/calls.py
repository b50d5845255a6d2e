"""Signature help: the call whose parentheses are open at the cursor, and its signature."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.cursor import InCode, locate_cursor
from skillc_compiler.ide.descriptions import format_parameter
from skillc_compiler.ide.term_pages import format_bare_type, format_function_head
from skillc_compiler.program.typed import Skill
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source

_CLOSING = {")": "(", "]": "[", "}": "{"}


class OpenCall(msgspec.Struct, frozen=True):
    """The call at the cursor: the callee, the labels passed so far, and the current argument.

    `position` is the index of the current argument; `label` is its parameter name, if it is already written.
    """

    name: str
    passed: tuple[str, ...]
    position: int
    label: str | None


class CallSignature(msgspec.Struct, frozen=True):
    """The signature of a call: its head and documentation, and each parameter with its documentation."""

    head: str
    documentation: str
    parameters: tuple[tuple[str, str], ...]
    active: int | None


def find_open_call(tokens: Sequence[Token]) -> OpenCall | None:
    """Return the innermost call that is still open after `tokens`."""
    opening = _unclosed(tokens)
    if opening is None or tokens[opening].type != "LPAR" or opening == 0:
        return None
    callee = opening - 4 if tokens[opening - 1].type == "RSQB" and opening >= 4 else opening - 1
    if not tokens[callee].value[:1].isalpha() or tokens[callee].type in ("CHECK", "NOT", "AND", "OR", "IMPLIES"):
        return None
    arguments = _split(tokens[opening + 1 :])
    names = [part[0].value.rstrip(":") for part in arguments[:-1] if part]
    current = arguments[-1]
    label = current[0].value.rstrip(":") if current and current[0].type == "LABEL" else None
    return OpenCall(tokens[callee].value, tuple(names), len(arguments) - 1, label)


def find_signature(analysis: Analysis, path: str, line: int, column: int) -> CallSignature | None:
    """Return the signature of the call around a place, or None outside of calls and for an unknown callee."""
    source = Source(path, analysis.texts.get(path, ""), edition=analysis.edition(path))
    cursor = locate_cursor(source, line, column)
    call = find_open_call(cursor.before) if isinstance(cursor, InCode) else None
    if call is None:
        return None
    skill = analysis.program.skills.get(call.name)
    if skill is not None:
        return _of_skill(analysis, skill, call)
    function = analysis.program.vocabulary.functions.get(call.name)
    if function is None:
        return None
    parameters = tuple((f"{name}: {format_bare_type(kind)}", "") for name, kind in function.parameters)
    active = call.position if call.position < len(parameters) else None
    return CallSignature(format_function_head(function).removeprefix("function "), function.comment, parameters, active)


def _of_skill(analysis: Analysis, skill: Skill, call: OpenCall) -> CallSignature:
    """Return the signature of a skill; the active parameter is the named one, else the first that is not passed."""
    takes = [parameter for parameter in skill.parameters if parameter.direction != "out"]
    parameters = tuple((format_parameter(analysis, parameter), parameter.doc) for parameter in takes)
    outputs = [format_bare_type(parameter.declared) for parameter in skill.parameters if parameter.direction == "out"]
    head = f"{skill.name}({', '.join(line for line, _ in parameters)})" + "".join(f" -> {kind}" for kind in outputs)
    free = [index for index, parameter in enumerate(takes) if parameter.name not in call.passed]
    named = [index for index, parameter in enumerate(takes) if parameter.name == call.label]
    active = next(iter((*named, *free)), None)
    return CallSignature(head, skill.doc, parameters, active)


def _unclosed(tokens: Sequence[Token]) -> int | None:
    """Return the index of the innermost bracket that is not closed."""
    depth = 0
    for index in range(len(tokens) - 1, -1, -1):
        if tokens[index].value in _CLOSING:
            depth += 1
        elif tokens[index].value in _CLOSING.values():
            if depth == 0:
                return index
            depth -= 1
    return None


def _split(tokens: Sequence[Token]) -> list[list[Token]]:
    """Split tokens at the commas that are not inside nested brackets."""
    parts: list[list[Token]] = [[]]
    depth = 0
    for token in tokens:
        depth += (token.value in _CLOSING.values()) - (token.value in _CLOSING)
        if token.type == "COMMA" and depth == 0:
            parts.append([])
        else:
            parts[-1].append(token)
    return parts
