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
    found = dict(_locals(implementation or skill or task, implementation, analysis.types))
    found |= dict(_quantified(cursor.before, visible))
    return CursorContext(visible, skill, implementation, task, most_specific_classes(program.vocabulary, scene), found)


def _locals(
    owner: Skill | Implementation | Task | None, implementation: Implementation | None, types: Mapping[Span, Type]
) -> Iterator[tuple[str, Type]]:
    for parameter in owner.parameters if owner else ():
        yield parameter.name, parameter.type
    if implementation is None:
        return
    for let in implementation.lets:
        yield let.name.text, let.value.type
    if isinstance(implementation.body, TypedNode):
        for step in nodes_in(implementation.body):
            yield from _bound(step)


def _bound(step: TypedNode) -> Iterator[tuple[str, Type]]:
    if isinstance(step.written, s.For):
        items = step.values[0].type
        yield step.written.variable.text, items.element if isinstance(items, ListOf) else UNKNOWN
    if isinstance(step.written, s.OnFailure) and step.written.why is not None:
        yield step.written.why.text, TEXT
    if step.call and step.call.out:
        outputs = [p.type for p in step.call.skill.parameters if p.direction == "out"] if step.call.skill else []
        yield step.call.out.text, outputs[0] if outputs else UNKNOWN


def _quantified(tokens: Sequence[Token], visible: VisibleNames) -> Iterator[tuple[str, Type]]:
    """Yield the variables of quantifiers, and the sides of a relation that is being defined."""
    sides = ("LPAR", "COMMA") if tokens and tokens[0].type == "RELATION" else ()
    in_head = False
    for before, first, label, cls in zip((*tokens[:1], *tokens), tokens, tokens[1:], tokens[2:], strict=False):
        in_head = first.type in ("EXISTS", "FORALL", "SOME") or (in_head and first.type != "LPAR")
        is_aggregate = first.type == "LPAR" and before.value in AGGREGATES
        if label.type == "LABEL" and (is_aggregate or in_head or first.type in ("FOR", *sides)):
            iri = visible.term("class", cls.value)
            yield label.value.rstrip(":"), Thing(iri) if iri else UNKNOWN
