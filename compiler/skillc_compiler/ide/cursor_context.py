"""The scope at the cursor: the enclosing declaration, and the local names with their types."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.cursor import InCode
from skillc_compiler.ide.visible import VisibleNames
from skillc_compiler.program.typed import Implementation, Skill, Task, TypedNode
from skillc_compiler.program.types import TEXT, UNKNOWN, ListOf, Thing, Type, type_of
from skillc_compiler.program.walk import nodes_in
from skillc_compiler.resolve.aggregates import AGGREGATES
from skillc_compiler.resolve.individuals import most_specific_classes
from skillc_compiler.resolve.links import type_of_link
from skillc_dsl import syntax as s
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Span


class CursorContext(msgspec.Struct, frozen=True):
    """The declaration around the cursor, as far as it was resolved, and the names visible in it."""

    visible: VisibleNames
    skill: Skill | None
    implementation: Implementation | None
    task: Task | None
    individuals: Mapping[str, str | None]
    locals: Mapping[str, Type]

    def type_of(self, tokens: Sequence[Token]) -> Type:
        """Return the type of the value at the end of `tokens`: `a`, `a.b`, `f(..)`, `lab:Board-1`."""
        if not tokens:
            return UNKNOWN
        last = tokens[-1]
        if last.type == "RPAR":
            return self._result(tokens)
        if len(tokens) > 2 and tokens[-2].type == "DOT":
            iri, known = self.visible.read_term(last.value), self.visible.vocabulary
            if iri in known.properties:
                return type_of(known.properties[iri].type)
            return type_of_link(known, known.relations[iri], UNKNOWN) if iri in known.relations else UNKNOWN
        if ":" in last.value:
            iri = self.visible.iri(last.value)
            return Thing(self.individuals.get(iri)) if iri else UNKNOWN
        return self.locals.get(last.value, UNKNOWN)

    def _result(self, tokens: Sequence[Token]) -> Type:
        depth = 0
        for index in range(len(tokens) - 1, 0, -1):
            depth += (tokens[index].type == "RPAR") - (tokens[index].type == "LPAR")
            if depth == 0:
                function = self.visible.vocabulary.functions.get(tokens[index - 1].value)
                return type_of(function.result) if function else UNKNOWN
        return UNKNOWN


def find_context(analysis: Analysis, path: str, cursor: InCode) -> CursorContext | None:
    """Return the scope at the cursor, or None in a file that was not analysed."""
    visible = analysis.visible.get(path)
    if visible is None:
        return None
    words = [token.value for token in cursor.before[:4]]
    kind = words[0] if words else ""
    program = analysis.program
    name = words[1] if len(words) > 1 else ""
    of = words[3] if kind == "impl" and len(words) > 3 else name
    skill = program.skills.get(of) if kind in ("skill", "impl") else None
    ways = program.implementations_of.get(of, ()) if kind == "impl" else ()
    implementation = next((way for way in ways if way.name == name), None)
    task = next((task for task in program.tasks if kind in ("task", "test") and task.name == name), None)
    scene = analysis.library.scenes.get(name, {}) if kind in ("task", "test") else {}
    open_ = find_open_names(cursor.before)
    found = {
        name: kind
        for name, kind, is_bound in _locals(implementation or skill or task, implementation, analysis.types)
        if not is_bound or name in open_
    }
    for name, cls in open_.items():
        iri = visible.term("class", cls) if cls else None
        if iri is not None or name not in found:
            found[name] = Thing(iri) if iri else UNKNOWN
    return CursorContext(visible, skill, implementation, task, most_specific_classes(program.vocabulary, scene), found)


def _locals(
    owner: Skill | Implementation | Task | None, implementation: Implementation | None, types: Mapping[Span, Type]
) -> Iterator[tuple[str, Type, bool]]:
    """Yield the names of a declaration with their types, and whether a node binds them, so that they have a scope."""
    for parameter in owner.parameters if owner else ():
        yield parameter.name, parameter.type, False
    for let in implementation.lets if implementation else ():
        yield let.name.text, let.value.type, False
    body = implementation.body if implementation else owner.body if isinstance(owner, Task) else None
    if isinstance(body, TypedNode):
        for step in nodes_in(body):
            yield from ((name, kind, True) for name, kind in _bound(step))


def _bound(step: TypedNode) -> Iterator[tuple[str, Type]]:
    if isinstance(step.written, s.For):
        items = step.values[0].type
        yield step.written.variable.text, items.element if isinstance(items, ListOf) else UNKNOWN
    if isinstance(step.written, s.OnFailure) and step.written.why is not None:
        yield step.written.why.text, TEXT
    if step.call and step.call.out:
        outputs = [p.type for p in step.call.skill.parameters if p.direction == "out"] if step.call.skill else []
        yield step.call.out.text, outputs[0] if outputs else UNKNOWN


def find_open_names(tokens: Sequence[Token]) -> Mapping[str, str]:
    """Return the names that nodes and conditions have bound up to the end of the tokens, and that can be read there.

    Each has its class, which is empty if none is written. A variable ends with the parentheses or braces that it is of,
    an output with the declaration.
    """
    scopes: list[dict[str, str]] = [{}]
    heads: dict[str, dict[str, str]] = {"LPAR": {}, "LBRACE": {}}
    closed: dict[str, str] = {}
    ends = {"RPAR": "LPAR", "RBRACE": "LBRACE"}
    for before, first, second, third in _windows(tokens):
        if first.type in heads:
            scopes.append(heads[first.type])
            heads[first.type] = {}
        elif first.type in ends and len(scopes) > 1:
            scopes.pop()
        name, cls = second.value.rstrip(":"), third.value
        match before.type, first.type, second.type:
            case "RPAR", "ARROW", "NAME":
                closed[name] = ""
            case _, "FOR" | "AS", "LABEL" | "NAME":
                heads["LBRACE"][name] = cls if second.type == "LABEL" else ""
            case _, "EXISTS" | "FORALL" | "SOME", "LABEL":
                heads["LPAR"][name] = cls
            case _, "COMMA", "LABEL" if heads["LPAR"]:
                heads["LPAR"][name] = cls
            case _, "LPAR", "LABEL" if before.value in AGGREGATES:
                scopes[-1][name] = cls
            case _, "LPAR" | "COMMA", "LABEL" if tokens[0].type == "RELATION" and len(scopes) <= 2:
                closed[name] = cls
            case _:
                pass
    return {name: cls for each in (closed, *scopes, *heads.values()) for name, cls in each.items()}


def _windows(tokens: Sequence[Token]) -> Iterator[tuple[Token, Token, Token, Token]]:
    """Yield each token with the one before it and the two after it; what is not there is empty."""
    nothing = Token("", "")
    padded = (nothing, *tokens, nothing, nothing)
    return zip(padded, padded[1:], padded[2:], padded[3:], strict=False)
