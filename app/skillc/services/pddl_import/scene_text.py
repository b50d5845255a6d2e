"""Writes the scene: objects and constants, and what is so at first."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import product
from math import prod

from skillc.services.pddl_import.conditions import Scope, Writer
from skillc.services.pddl_import.declarations import Problem, Typed
from skillc.services.pddl_import.expressions import BrokenPddl, Findings, Missing, Node, refuse
from skillc.services.pddl_import.names import Names
from skillc.services.pddl_import.terms import PREFIX, Entry, Property, Relation

MOST_ENTRIES = 20_000
"""How many things may stand for the tuples of one predicate that changes."""


class SceneWriter:
    """Collects what is said of each individual."""

    def __init__(self, writer: Writer, findings: Findings, prefix: str) -> None:
        self._writer, self._findings, self._prefix = writer, findings, prefix
        self._facts: dict[str, dict[str, list[str]]] = {}
        self._classes: dict[str, str] = {}
        self._counts: dict[str, int] = {}
        self._scope = Scope({}, Names())

    def write(self, problem: Problem | None, title: str, iri: str, namespace: str) -> str:
        """Return the text of the scene."""
        terms = self._writer.terms
        if problem is not None:
            self._add_tuples()
            for node in problem.init:
                self._add(node)
        lines = [f"# {title}", f"@prefix {PREFIX}: <{iri}> .", f"@prefix {self._prefix}: <{namespace}> ."]
        lines += ["@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .", ""]
        if terms.world_class:
            lines.append(self._individual(terms.world(), terms.world_class, ""))
        for name, typed in self._writer.objects.items():
            own = terms.individuals[name]
            shown = typed.written if own != f"{PREFIX}:{typed.written}" else ""
            lines.append(self._individual(own, terms.class_of(typed.types), shown))
        lines += [self._individual(entry, cls, "") for entry, cls in self._classes.items()]
        return "\n".join(lines) + "\n"

    def _individual(self, name: str, cls: str, label: str) -> str:
        parts = [f"a {self._prefix}:{cls}"]
        if label:
            parts.append(f"rdfs:label {json.dumps(label, ensure_ascii=False)}")
        parts += [f"{self._prefix}:{term} {', '.join(values)}" for term, values in self._facts.get(name, {}).items()]
        return f"{name} {' ; '.join(parts)} ."

    def _state(self, subject: str, term: str, value: str, single: bool = False) -> None:
        values = self._facts.setdefault(subject, {}).setdefault(term, [])
        if single:
            values.clear()
        if value not in values:
            values.append(value)

    def _add(self, node: Node) -> None:
        try:
            self._add_fact(node)
        except Missing as missing:
            self._findings.add_missing(missing)
        except BrokenPddl as error:
            self._findings.add_error(error)

    def _add_fact(self, node: Node) -> None:
        match node.head:
            case "not" if len(node.items) == 2:
                self._writer.atom(node.items[1], self._scope)
            case "=" if len(node.items) == 3:
                self._add_number(node)
            case "at" if len(node.items) == 3 and node.items[2].is_list:
                raise Missing(node, f"what becomes so at a time is not in the scene: `{node}`")
            case _:
                self._add_atom(node)

    def _add_number(self, node: Node) -> None:
        what, value = node.rest
        name = what.head or what.word
        if name == self._writer.terms.domain.cost:
            return
        functions = self._writer.terms.domain.functions
        if name not in functions:
            self._writer.number(what, self._scope)
        number = self._writer.number(value, self._scope).text.strip("()")
        own = what if what.is_list else Node(what.span, items=(what,))
        arguments = self._writer.arguments(own, functions[name], self._scope)
        form = self._writer.terms.functions[name]
        if isinstance(form, Property):
            self._state(arguments[0] if arguments else self._writer.terms.world(), form.name, number, single=True)
        elif isinstance(form, Entry):
            self._state(self._entry(form, arguments), form.value, number, single=True)

    def _add_atom(self, node: Node) -> None:
        form, symbol = self._writer.form(node)
        arguments = self._writer.arguments(node, symbol, self._scope)
        match form:
            case Property(name=name):
                self._state(arguments[0] if arguments else self._writer.terms.world(), name, "true", single=True)
            case Relation(name=name):
                self._state(arguments[0], name, arguments[1])
            case Entry(value=value):
                entry = self._entry(form, arguments)
                if value:
                    self._state(entry, value, "true", single=True)
            case _:
                refuse(node, f"`{symbol.node.written}` is derived: it follows from other facts")

    def _entry(self, form: Entry, arguments: tuple[str, ...]) -> str:
        known, key = self._writer.entries, (form.cls, *arguments)
        if key not in known:
            number = self._counts[form.cls] = self._counts.get(form.cls, 0) + 1
            known[key] = entry = self._writer.terms.name_individual(f"{form.cls}-{number}")
            self._classes[entry] = form.cls
            for side, argument in zip(form.sides, arguments, strict=True):
                self._state(entry, side, argument)
        return known[key]

    def _add_tuples(self) -> None:
        """Add things for all tuples of the predicates that change, which may become true of each."""
        terms = self._writer.terms
        for form in terms.forms.values():
            if not isinstance(form, Entry) or not form.value:
                continue
            choices = [self._of_types(each, self._writer.objects) for each in form.symbol.parameters]
            if prod(map(len, choices)) > MOST_ENTRIES:
                written = form.symbol.node.written
                what = f"`{written}` has more than {MOST_ENTRIES:,} tuples: only those of the start are in the scene"
                self._findings.add_missing(Missing(form.symbol.node, what))
                continue
            for chosen in product(*choices):
                self._entry(form, chosen)

    def _of_types(self, parameter: Typed, objects: Mapping[str, Typed]) -> list[str]:
        terms = self._writer.terms
        return [terms.individuals[name] for name, each in objects.items() if _fits(each, parameter, self._writer)]


def _fits(each: Typed, parameter: Typed, writer: Writer) -> bool:
    return any(writer.terms.domain.is_a(mine, wanted) for mine in each.types for wanted in parameter.types)
