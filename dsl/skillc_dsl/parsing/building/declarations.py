"""Builds declarations and files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Literal, TypeVar, cast

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.parsing.building.members import MemberBuilder
from skillc_dsl.parsing.building.places import (
    Child,
    MemberPart,
    MemberParts,
    Spanned,
    children_of_type,
    find_part,
    first_of_type,
    keyword_at,
)
from skillc_dsl.parsing.reserved import needs_prefix
from skillc_dsl.parsing.tokens import Tree
from skillc_dsl.source import Span

P = TypeVar("P", bound=Spanned)
TraitKind = Literal["functional", "symmetric", "transitive", "inverse", "sub"]


class FileBuilder(MemberBuilder):
    """Builds declarations; `start` is the whole file."""

    def file(self, tree: Tree) -> s.File:
        """Return the syntax tree of a file for its parse tree."""
        file = self.build(tree)
        if not isinstance(file, s.File):
            raise TypeError(f"a file was expected, not {file!r}")
        return file

    def start(self, children: list[Child]) -> s.File:
        """The file."""
        header = tuple(child for child in children if isinstance(child, s.Use | s.Prefix | s.Import))
        declarations = tuple(child for child in children if isinstance(child, s.Declaration))
        return s.File(self.source.path, header, declarations)

    def use(self, children: list[Child]) -> s.Use:
        """`use skiros, rparts`"""
        return s.Use(children_of_type(children, s.Name), self.over(children))

    def prefix(self, children: list[Child]) -> s.Prefix:
        """`prefix lab: <iri>`"""
        return s.Prefix(self.label(children[1]), keyword_at(children, 2)[1:-1], self.over(children))

    def import_(self, children: list[Child]) -> s.Import:
        """`import "file.skill"`"""
        return s.Import(self.string(children[1]), self.over(children))

    def class_(self, children: list[Child]) -> s.ClassDeclaration:
        """`class Name < Parent, .. disjoint Other, ..`"""
        parents, disjoint = find_part(children, "parents"), find_part(children, "disjoint")
        span = self.over(children)
        return s.ClassDeclaration(
            self.as_name(children[1]),
            children_of_type(parents.children, s.Name) if parents else (),
            children_of_type(disjoint.children, s.Name) if disjoint else (),
            self.doc(span),
            span,
        )

    def parents(self, children: list[Child]) -> MemberPart:
        """`< Parent, ..`"""
        return self.part("parents", children)

    def disjoint(self, children: list[Child]) -> MemberPart:
        """`disjoint Other, ..`"""
        return self.part("disjoint", children)

    def enum(self, children: list[Child]) -> s.ClassDeclaration:
        """`enum Name { Value, .. }`"""
        (name, *values), span = children_of_type(children, s.Name), self.over(children)
        return s.ClassDeclaration(name, (), (), self.doc(span), span, tuple(values))

    def relation(self, children: list[Child]) -> s.RelationDeclaration:
        """`relation name(Domain, Range) traits` or `relation name(x: Domain, y: Range) = condition`"""
        span, written = self.over(children), find_part(children, "definition")
        if written is None:
            name, domain, range_ = children_of_type(children, s.Name)
            traits = children_of_type(children, s.Trait)
            return s.RelationDeclaration(name, domain, range_, traits, self.doc(span), span)
        (subject, domain), (object_, range_) = (
            (self.label(part.children[0]), self.as_name(part.children[1]))
            for part in children_of_type(children, MemberPart)
            if part.rule == "side"
        )
        condition = self.condition(written.children[1])
        definition = s.Definition(subject, object_, condition, self.written(condition.span), written.span)
        return s.RelationDeclaration(self.as_name(children[1]), domain, range_, (), self.doc(span), span, definition)

    def side(self, children: list[Child]) -> MemberPart:
        """`x: Class` in the head of a defined relation"""
        return self.part("side", children)

    def definition(self, children: list[Child]) -> MemberPart:
        """`= condition`"""
        return self.part("definition", children)

    def trait(self, children: list[Child]) -> s.Trait:
        """`functional`, `inverse NAME` and their like"""
        name = self.as_name(children[1]) if len(children) > 1 else None
        return s.Trait(cast(TraitKind, keyword_at(children, 0)), name, self.over(children))

    def property(self, children: list[Child]) -> s.PropertyDeclaration:
        """`property name(Domain): Type range a .. b`"""
        span = self.over(children)
        name, domain = self.as_name(children[1]), self.as_name(children[3])
        bounds = first_of_type(children, s.Range)
        return s.PropertyDeclaration(name, domain, self.type_at(children, 6), self.doc(span), span, bounds)

    def function(self, children: list[Child]) -> s.FunctionDeclaration:
        """`function name(parameter, ..) -> Type = python "module:function"`"""
        span = self.over(children)
        return s.FunctionDeclaration(
            self.as_name(children[1]),
            children_of_type(children, s.HeadParameter),
            self.type_at(children, len(children) - 4),
            self.string(children[-1]),
            self.doc(span),
            span,
        )

    def head_parameter(self, children: list[Child]) -> s.HeadParameter:
        """`name: Type`"""
        return s.HeadParameter(self.label(children[0]), self.type_at(children, 1), self.over(children))

    def skill(self, children: list[Child]) -> s.SkillDeclaration:
        """`skill Name { members }`"""
        several = ((each.members if isinstance(each, MemberParts) else (each,)) for each in children)
        written = [each for parts in several for each in parts if isinstance(each, s.SkillMember)]
        members = tuple(self._without_relations(written))
        span = self.over(children)
        return s.SkillDeclaration(self.as_name(children[1]), members, self.doc(span), span)

    def _without_relations(self, members: Sequence[s.SkillMember]) -> Iterator[s.SkillMember]:
        """Yield the members without a condition `a senses b`, which reads as a value and a member: report it."""
        meant: set[int] = set()
        for index, (one, other) in enumerate(pairwise(members)):
            is_value = isinstance(one, s.Requirement) and isinstance(one.condition, s.Bare)
            if is_value and isinstance(other, s.Senses) and one.span.end_line == other.span.line:
                word = self.written(other.span).split()[0]
                start = other.span
                end = start._replace(end_line=start.line, end_column=start.column + len(word))
                self.problems.append(needs_prefix(word, end))
                meant |= {index, index + 1}
        return (each for index, each in enumerate(members) if index not in meant)

    def impl(self, children: list[Child]) -> s.ImplementationDeclaration:
        """`impl name of Skill { members }`"""
        name, skill = children_of_type(children, s.Name)
        members = tuple(self._without_what_skills_say(children))
        span = self.over(children)
        return s.ImplementationDeclaration(name, skill, members, self.doc(span), span)

    def _without_what_skills_say(self, children: list[Child]) -> Iterator[s.ImplementationMember]:
        """Yield the members of an implementation; report what is said of a skill, whatever the way to do it."""
        for child in children:
            word = "some" if isinstance(child, MemberParts) else ""
            word = "possible" if isinstance(child, s.Requirement) and child.kind == "possible" else word
            if word and isinstance(child, s.Requirement | MemberParts):
                message = f"`post {word}` is what a skill says, not one way to do it"
                self.complain(child.span, message, "write it in the skill")
            elif isinstance(child, s.ImplementationMember):
                yield child

    def task(self, children: list[Child]) -> s.TaskDeclaration:
        """`task name(parameter, ..) { scene, backend, goal or do, always .., within, minimise }`"""
        return s.TaskDeclaration(*self._task("task", children))

    def test(self, children: list[Child]) -> s.TestDeclaration:
        """`test name { scene, start .., goal or do, always .., expect .. }`"""
        starts, expects = children_of_type(children, s.Start), children_of_type(children, s.Expect)
        outcomes = children_of_type(children, s.StartOutcome)
        return s.TestDeclaration(*self._task("test", children), starts, outcomes, expects)

    def _task(
        self, word: str, children: list[Child]
    ) -> tuple[
        s.Name,
        tuple[s.HeadParameter, ...],
        s.Text | None,
        s.Condition | None,
        str,
        s.Body | None,
        s.Name | None,
        s.Value | None,
        s.Minimise | None,
        tuple[s.Always, ...],
        str,
        Span,
    ]:
        """Return the fields of a task or a test, which is called `word` in messages."""
        name, span = self.as_name(children[1]), self.over(children)
        parts = (self._only_part(word, children, rule) for rule in ("scene", "goal", "backend", "within"))
        scene, goal, backend, within = parts
        condition = self.condition(goal.children[1]) if goal else None
        return (
            name,
            children_of_type(children, s.HeadParameter),
            self.string(scene.children[1]) if scene else None,
            condition,
            self.written(condition.span) if condition else "",
            self._only(word, children_of_type(children, s.Body)),
            self.as_name(backend.children[1]) if backend else None,
            self.value(within.children[1]) if within else None,
            self._only(word, children_of_type(children, s.Minimise)),
            children_of_type(children, s.Always),
            self.doc(span),
            span,
        )

    def start_fact(self, children: list[Child]) -> s.Start:
        """`start condition`"""
        return s.Start(self.condition(children[1]), self.over(children))

    def start_outcome(self, children: list[Child]) -> s.StartOutcome:
        """`start skill -> outcome`"""
        return s.StartOutcome(self.as_name(children[1]), self.as_name(children[3]), self.over(children))

    def expect(self, children: list[Child]) -> s.Expect:
        """`expect condition`, `expect failure "text"`, `expect no plan`"""
        span, word = self.over(children), keyword_at(children, 1)
        if word == "failure" and len(children) == 3:
            return s.Expect(None, self.string(children[2]), "", span)
        if word == "no" and len(children) == 3:
            return s.Expect(None, None, "", span)
        condition = self.condition(children[1])
        return s.Expect(condition, None, self.written(condition.span), span)

    def scene(self, children: list[Child]) -> MemberPart:
        """`scene "file.ttl"`"""
        return self.part("scene", children)

    def backend(self, children: list[Child]) -> MemberPart:
        """`backend name`"""
        return self.part("backend", children)

    def goal(self, children: list[Child]) -> MemberPart:
        """`goal condition`"""
        return self.part("goal", children)

    def within(self, children: list[Child]) -> MemberPart:
        """`within value`"""
        return self.part("within", children)

    def always(self, children: list[Child]) -> s.Always:
        """`always condition`"""
        return s.Always(self.condition(children[1]), self.over(children))

    def minimise(self, children: list[Child]) -> s.Minimise:
        """`minimise makespan|work|cost`"""
        return s.Minimise(cast(s.Measure, keyword_at(children, 1)), self.over(children))

    def _only_part(self, of: str, children: list[Child], rule: str) -> MemberPart | None:
        return self._only(of, (part for part in children_of_type(children, MemberPart) if part.rule == rule))

    def _only(self, of: str, found: Iterable[P]) -> P | None:
        """Return the first member of a kind and report all others."""
        members = tuple(found)
        for other in members[1:]:
            word = self.written(other.span).split()[0]
            labels = (Label(members[0].span, "the first one"),)
            message = f"the {of} has a second `{word}`"
            self.problems.append(Diagnostic("repeated-member", other.span, message, "keep one", labels=labels))
        return members[0] if members else None
