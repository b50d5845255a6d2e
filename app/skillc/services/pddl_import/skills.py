"""Writes an action as a skill."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc.services.pddl_import.conditions import PRODUCT, Scope, Text, Writer, root_scope
from skillc.services.pddl_import.declarations import Action
from skillc.services.pddl_import.effects import Effects, read_effects, write_posts
from skillc.services.pddl_import.expressions import BrokenPddl, Findings, Missing, Node, refuse
from skillc.services.pddl_import.names import Names, to_class
from skillc.services.pddl_import.terms import Entry

_TIMES = {("at", "start"): "start", ("over", "all"): "all", ("at", "end"): "end"}


@dataclass(frozen=True, slots=True)
class ActionWriter:
    """Writes actions as skills."""

    writer: Writer
    findings: Findings

    def write(self, action: Action, name: str) -> str:
        """Return the text of a skill; what is broken is noted."""
        scope = root_scope(action.parameters, Names())
        entries: dict[tuple[str, ...], tuple[str, Entry, tuple[str, ...]]] = {}
        scope.entries = entries
        class_of = self.writer.terms.class_of
        parameters = [
            f"in {own}: {class_of(each.types)}{_remark(own, each.written)}" for own, each in scope.variables.values()
        ]
        length = self._find_length(action)
        effect = action.effect
        if effect is not None and length is not None:
            effect = effect.with_words({"?duration": length})
        effects = read_effects(effect, scope, self.writer, self.findings)
        members = [*self._conditions(action, scope, effects), *effects.comments]
        posts = write_posts(effects, self.writer, self.findings)
        members += [each if each.startswith("#") else f"post {each}" for each in posts]
        members += [*self._locks(effects), *self._duration(action, scope), *self._cost(effects, scope)]
        parameters += [f"infer {entry}: {form.cls}" for entry, form, _ in entries.values()]
        for entry, form, arguments in entries.values():
            parameters += [
                f"pre {entry} {side} {argument}" for side, argument in zip(form.sides, arguments, strict=True)
            ]
        lines = "".join(f"    {each}\n" for each in (*parameters, *members))
        doc = f"## `{action.name.written}`\n" if to_class(action.name.written) != action.name.written else ""
        return f"{doc}skill {name} {{\n{lines}}}\n"

    def _locks(self, effects: Effects) -> Iterator[str]:
        """Yield what is taken at the start and given back at the end: it is locked while the skill runs."""
        given_back = {str(each.node) for each in effects.literals if each.positive and not each.at_start}
        for each in effects.literals:
            if each.positive or not each.at_start or str(each.node) not in given_back or each.variables or each.when:
                continue
            if len(each.node.items) == 2 and each.node.items[1].word.startswith("?"):
                yield f"uses {self.writer.term(each.node.items[1], each.scope)}"
            else:
                what = f"what ends at the start and is back at the end keeps no other skill waiting: `{each.node}`"
                yield self.findings.add_missing(Missing(each.node, what))

    def _conditions(self, action: Action, scope: Scope, effects: Effects) -> Iterator[str]:
        lost = {str(each.node) for each in effects.literals if not each.positive}
        seen = set[str]()
        for time, node in self._timed(action):
            try:
                text = self.writer.condition(node, scope).text
            except BrokenPddl as error:
                self.findings.add_error(error)
                continue
            except Missing as missing:
                yield self.findings.add_missing(missing)
                continue
            ends = time in ("all", "end") and str(node) in lost
            if time == "end" and text:
                self._note_end(node, ends)
            line = f"{'hold' if time in ('all', 'end') and not ends else 'pre'} {text}"
            if text and line not in seen:
                seen.add(line)
                yield line

    def _note_end(self, node: Node, ends: bool) -> None:
        when = "at its start" if ends else "all the time"
        self.findings.add_missing(Missing(node, f"what an action needs at its end, a skill needs {when}: `{node}`"))

    def _timed(self, action: Action) -> Iterator[tuple[str, Node]]:
        for node in self.writer.conjuncts(action.condition):
            yield from self._times(node) if action.durative else (("start", node),)

    def _times(self, node: Node) -> Iterator[tuple[str, Node]]:
        """Yield the parts of a condition of a durative action, with the times at which they have to hold."""
        if node.head == "forall" and len(node.items) == 3:
            for part in self.writer.conjuncts(node.items[2]):
                for time, each in self._times(part):
                    yield time, Node(node.span, items=(*node.items[:2], each))
            return
        when = _TIMES.get((node.head, node.items[1].word)) if len(node.items) == 3 else None
        if when is None:
            how = "write `(at start ..)`, `(over all ..)` or `(at end ..)`"
            refuse(node, f"`{node}` does not say when it has to hold", how)
        yield from ((when, each) for each in self.writer.conjuncts(node.items[2]))

    def _find_length(self, action: Action) -> Node | None:
        """Return the duration of a durative action; None if it has none."""
        try:
            return self._length(action)[0] if action.durative else None
        except BrokenPddl:
            return None

    def _duration(self, action: Action, scope: Scope) -> Iterator[str]:
        if not action.durative:
            return
        try:
            length, how = self._length(action)
            if how != "=":
                what = "the longest duration is taken" if how == "<=" else "the shortest duration is taken"
                self.findings.add_missing(Missing(action.duration or length, f"a skill has one duration: {what}"))
            yield f"duration {_seconds(self.writer.number(length, scope))}"
        except Missing as missing:
            yield self.findings.add_missing(missing)
        except BrokenPddl as error:
            self.findings.add_error(error)

    def _cost(self, effects: Effects, scope: Scope) -> Iterator[str]:
        """Yield what a skill costs, if actions of the domain cost anything: 0 unless its action says otherwise."""
        domain = self.writer.terms.domain
        if domain.cost not in domain.functions:
            return
        try:
            texts = [self.writer.number(each, scope).text for each in effects.costs]
            yield f"cost {' + '.join(texts) or 0}"
        except Missing as missing:
            yield self.findings.add_missing(missing)
        except BrokenPddl as error:
            self.findings.add_error(error)

    def _length(self, action: Action) -> tuple[Node, str]:
        """Return the duration of an action, and whether it is that: `>=` before the least one, `<=` the greatest."""
        if action.duration is None:
            refuse(action.place, f"`{action.name.written}` has no duration", "write `:duration (= ?duration NUMBER)`")
        parts = [each for each in self.writer.conjuncts(action.duration) if len(each.items) == 3]
        parts = [each.items[2] if each.head == "at" else each for each in parts]
        for wanted in ("=", ">=", "<="):
            for each in parts:
                if each.head == wanted and each.items[1].word == "?duration":
                    return each.items[2], wanted
        return refuse(action.duration, "no duration is stated here", "write `(= ?duration NUMBER)`")


def _seconds(number: Text) -> str:
    return f"{number.text} s" if number.text.replace(".", "").isdigit() else f"{number.within(PRODUCT)} * 1 s"


def _remark(name: str, written: str) -> str:
    return "" if name == written.lower() else f"  # ?{written}"
