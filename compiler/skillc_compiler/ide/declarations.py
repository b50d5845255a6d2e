"""The names in declarations and in the header of a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, assert_never

from skillc_compiler.ide.bodies import BodyContext, BodyOccurrences
from skillc_compiler.ide.symbols import (
    ChoiceSymbol,
    FileSymbol,
    FunctionSymbol,
    ImplementationSymbol,
    LabelSymbol,
    LocalSymbol,
    Occurrence,
    ParameterSymbol,
    PrefixSymbol,
    SceneSymbol,
    SkillSymbol,
    Symbol,
    TaskSymbol,
)
from skillc_compiler.ide.values import Locals
from skillc_compiler.program.program import ParsedFile
from skillc_dsl import syntax as s
from skillc_rdf.vocabulary.types import value_iri


class FileOccurrences(BodyOccurrences, frozen=True):
    """Finds all occurrences in one file."""

    def file(self, unit: ParsedFile) -> Iterator[Occurrence]:
        """Yield the occurrences in a file, in no particular order."""
        imported = {line.path.span: path for line, path in unit.imports}
        for line in unit.file.header:
            match line:
                case s.Use(vocabularies=vocabularies):
                    for name in vocabularies:
                        yield Occurrence(name.span, PrefixSymbol(name.text))
                case s.Prefix(name=name):
                    yield Occurrence(name.span, PrefixSymbol(name.text), declares=True)
                case s.Import(path=path):
                    if path.span in imported:
                        yield Occurrence(path.span, FileSymbol(imported[path.span]))
                case _:
                    assert_never(line)
        for declaration in unit.file.declarations:
            yield from self.declaration(declaration)

    def declaration(self, written: s.Declaration) -> Iterator[Occurrence]:
        """Yield the occurrences in a declaration."""
        match written:
            case s.ClassDeclaration(name=name, parents=parents, disjoint=disjoint, values=values):
                yield from self.term("class", name, declares=True)
                home = self.visible.term("class", name.text) or ""
                for value in values:
                    yield Occurrence(value.span, ChoiceSymbol(value.text, value_iri(home, value.text)), declares=True)
                for other in (*parents, *disjoint):
                    yield from self.term("class", other)
            case s.RelationDeclaration():
                yield from self._relation(written)
            case s.PropertyDeclaration(name=name, domain=domain, type=type_):
                yield from self.read(name, declares=True)
                yield from self.term("class", domain)
                yield from self.type(type_)
            case s.FunctionDeclaration():
                yield from self._function(written)
            case s.SkillDeclaration():
                yield from self._skill(written)
            case s.ImplementationDeclaration():
                yield from self._implementation(written)
            case s.TaskDeclaration():
                yield from self._task(written)
            case _:
                assert_never(written)

    def _relation(self, written: s.RelationDeclaration) -> Iterator[Occurrence]:
        yield from self.term("relation", written.name, declares=True)
        yield from self.term("class", written.domain)
        yield from self.term("class", written.range)
        for trait in written.traits:
            if trait.name is not None:
                yield from self.term("relation", trait.name)
        if written.definition is not None:
            yield from self._definition(written.definition)

    def _definition(self, written: s.Definition) -> Iterator[Occurrence]:
        known: dict[str, Symbol] = {}
        for name in (written.subject, written.object):
            known[name.text] = LocalSymbol("variable", written.span, name.text)
            yield Occurrence(name.span, known[name.text], declares=True)
        yield from self.condition(known, written.condition)

    def _function(self, written: s.FunctionDeclaration) -> Iterator[Occurrence]:
        yield Occurrence(written.name.span, FunctionSymbol(written.name.text), declares=True)
        known: dict[str, Symbol] = {}
        yield from self._head("function parameter", written, known)
        yield from self.type(written.result)

    def _head(
        self,
        origin: Literal["function parameter", "task parameter"],
        written: s.FunctionDeclaration | s.TaskDeclaration,
        known: dict[str, Symbol],
    ) -> Iterator[Occurrence]:
        """Yield the parameters of a head, and add them to `known`."""
        for parameter in written.parameters:
            symbol = LocalSymbol(origin, written.span, parameter.name.text)
            known[parameter.name.text] = symbol
            yield Occurrence(parameter.name.span, symbol, declares=True)
            yield from self.type(parameter.type)

    def _skill(self, written: s.SkillDeclaration) -> Iterator[Occurrence]:
        name = written.name.text
        known: dict[str, Symbol] = {}
        yield Occurrence(written.name.span, SkillSymbol(name), declares=True)
        for member in written.members:
            if isinstance(member, s.Parameter):
                symbol = ParameterSymbol(name, member.name.text)
                known[member.name.text] = symbol
                yield Occurrence(member.name.span, symbol, declares=True)
                yield from self._typed(member)
        typed = self.skills.get(name)
        taken = [each for each in (typed.parameters if typed is not None else ()) if each.taken_from]
        known |= {each.name: ParameterSymbol.of(name, each) for each in taken}
        for member in written.members:
            match member:
                case s.Requirement():
                    yield from self._requirement(known, name, member)
                case s.TakenOver(call=call):
                    yield from self.call(BodyContext(written.span, name), known, call)
                case s.Duration(value=value) | s.Cost(value=value) | s.Senses(value=value):
                    yield from self.value(known, value)
                case s.DeviceUse(parameter=parameter) if parameter.span == member.span:  # of what is declared there
                    pass
                case s.DeviceUse(parameter=parameter):
                    yield from self.reference(known, parameter)
                case s.Pause(keep=keep):
                    yield from self.value(known, keep) if keep else ()
                case s.Parameter() | s.Flag():
                    pass
                case _:
                    assert_never(member)

    def _implementation(self, written: s.ImplementationDeclaration) -> Iterator[Occurrence]:
        home = BodyContext(written.span, written.skill.text, written.name.text)
        skill = self.skills.get(home.skill)
        known: dict[str, Symbol] = (
            {p.name: ParameterSymbol.of(home.skill, p) for p in skill.parameters} if skill else {}
        )
        yield Occurrence(written.name.span, ImplementationSymbol(home.skill, home.implementation), declares=True)
        if skill:
            yield Occurrence(written.skill.span, SkillSymbol(home.skill))
        lets = [member for member in written.members if isinstance(member, s.Let)]
        for let in lets:
            yield from self.value(known, let.value)
            symbol = LocalSymbol("let", written.span, let.name.text)
            yield from self.bound(known, let.name, symbol)
            known.setdefault(let.name.text, symbol)
        yield from self._members(home, known, written.members)

    def _members(
        self, home: BodyContext, known: dict[str, Symbol], members: Sequence[s.ImplementationMember]
    ) -> Iterator[Occurrence]:
        for member in members:
            match member:
                case s.Refinement(name=name):
                    yield from self.reference(known, name)
                    yield from self._typed(member)
                case s.Requirement():
                    yield from self._requirement(known, f"{home.skill}.{home.implementation}", member)
                case s.Duration(value=value):
                    yield from self.value(known, value)
                case s.Body(node=node):
                    yield from self.node(home, known, node)
                case s.Verify(first=first, second=second):
                    for event in (first, second):
                        yield from self._event(known, event)
                case s.Let() | s.Output() | s.Prefer() | s.RunPython():
                    pass
                case _:
                    assert_never(member)
        for member in members:
            if isinstance(member, s.Output):  # reads what the body has named
                yield from self.reference(known, member.name)
                yield from self.value(known, member.value)

    def _task(self, written: s.TaskDeclaration) -> Iterator[Occurrence]:
        known: dict[str, Symbol] = {}
        yield Occurrence(written.name.span, TaskSymbol(written.name.text), declares=True)
        yield from self._head("task parameter", written, known)
        if written.scene is not None:
            yield Occurrence(written.scene.span, SceneSymbol(written.scene.value))
        if written.goal is not None:
            yield from self.condition(known, written.goal)
        for always in written.always:
            yield from self.condition(known, always.condition)
        if isinstance(written, s.TestDeclaration):
            for start in written.starts:
                yield from self.condition(known, start.condition)
            for outcome in written.outcomes:
                yield from self._start_outcome(outcome)
            for expected in written.expects:
                yield from self.condition(known, expected.condition) if expected.condition is not None else ()
        if written.body is not None:
            yield from self.node(BodyContext(written.span), known, written.body.node)

    def _start_outcome(self, written: s.StartOutcome) -> Iterator[Occurrence]:
        if written.skill.text in self.visible.skills:
            yield Occurrence(written.skill.span, SkillSymbol(written.skill.text))
            yield Occurrence(written.outcome.span, LabelSymbol(written.skill.text, written.outcome.text))

    def _typed(self, member: s.Parameter | s.Refinement) -> Iterator[Occurrence]:
        yield from self.type(member.type)
        bounds = (member.range.low, member.range.high) if member.range else ()
        for value in (*((member.default,) if member.default is not None else ()), *bounds):
            yield from self.value({}, value)

    def _requirement(self, known: Locals, owner: str, member: s.Requirement) -> Iterator[Occurrence]:
        if member.label is not None:
            yield Occurrence(member.label.span, LabelSymbol(owner, member.label.text), declares=True)
        yield from self.condition(known, member.condition)

    def _event(self, known: Locals, event: s.VerifyEvent | None) -> Iterator[Occurrence]:
        match event:
            case None:
                return
            case s.VerifyEvent(what=s.Name(text=text, span=span)):
                if text in self.visible.skills:
                    yield Occurrence(span, SkillSymbol(text))
            case s.VerifyEvent(what=condition) if not isinstance(condition, s.Name):
                yield from self.condition(known, condition)
