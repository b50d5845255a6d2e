"""Which bodies are free of other errors: in the rest, a proof would only repeat them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_compiler.analysis.alias_types import AliasTypes
from skillc_compiler.analysis.assume import assume
from skillc_compiler.analysis.axioms import CanonicalAxioms
from skillc_compiler.analysis.findings import Finding, UnassignedOutput, UnassignedRead
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.state import State
from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.typed import (
    Call,
    Implementation,
    Program,
    Requirement,
    Skill,
    Task,
    TypedCondition,
    TypedExpression,
    TypedNode,
)
from skillc_compiler.program.types import UNKNOWN, fits
from skillc_compiler.program.walk import conditions_in, node_values, nodes_in, values_in
from skillc_dsl import syntax as s
from skillc_model.conditions import HasProperty, Holds, IsA, PropertyOf
from skillc_model.traversal import walk


class Understood:
    """Stores for each skill whether its description has no unresolved part."""

    def __init__(self, program: Program, axioms: CanonicalAxioms) -> None:
        self._program = program
        self._axioms = axioms
        self._skills: dict[str, bool] = {}

    def sound(self, of: Implementation | Task, findings: Iterable[Finding], clear: bool) -> Iterator[Finding]:
        """Yield the findings that are independent of other errors; `clear` if the conditions can be satisfied."""
        whole = clear and self._body(of)
        for finding in findings:
            if whole or isinstance(finding, UnassignedRead | UnassignedOutput):
                yield finding

    def _body(self, of: Implementation | Task) -> bool:
        if isinstance(of, Implementation):
            clear = self._skill(of.skill) and self._requirements(of.requirements)
            if not clear or not self._values(let.value for let in of.lets):
                return False
        posts = requirements_of(of, "post") if isinstance(of, Implementation) else ()
        labels = {post.label.text for post in posts if post.label and not post.sensed}
        return not isinstance(of.body, TypedNode) or all(self._step(node, labels) for node in nodes_in(of.body))

    def _step(self, node: TypedNode, labels: set[str]) -> bool:
        if isinstance(node.written, s.ApplyPosts) and not labels.issuperset(name.text for name in node.written.labels):
            return False
        if not self._values(node_values(node)) or not all(self._clause(condition) for condition in node.conditions):
            return False
        return node.call is None or self._call(node.call)

    def _call(self, call: Call) -> bool:
        if call.skill is None or not self._skill(call.skill):
            return False
        passed = {argument.name.text for argument in call.written.arguments}
        if len(passed) < len(call.written.arguments) or len(call.arguments) < len(call.written.arguments):
            return False
        fitting = (
            fits(self._program.vocabulary, argument.value.type, parameter.type)
            for argument in call.arguments
            for parameter in call.skill.parameters
            if parameter.name == argument.name.text
        )
        return all(fitting) and all(p.name in passed for p in call.skill.parameters if p.direction == "in")

    def _skill(self, skill: Skill) -> bool:
        if skill.name not in self._skills:
            known = self._program.implementations_of.get(skill.name, ())
            own = all(self._requirements(one.requirements) for one in known)
            typed = all(p.type != UNKNOWN for p in skill.parameters)
            self._skills[skill.name] = own and typed and self._requirements(skill.requirements)
        return self._skills[skill.name]

    def _requirements(self, requirements: Iterable[Requirement]) -> bool:
        return all(self._clause(each.condition) and _is_post(each) for each in requirements)

    def _clause(self, whole: TypedCondition) -> bool:
        vocabulary = self._program.vocabulary
        if assume(AliasTypes(vocabulary, self._axioms), State(), whole.meaning) is None:
            return False
        for condition in conditions_in(whole):
            if not self._values(condition.values):
                return False
            match condition.meaning:
                case Holds(relation=iri) if iri not in vocabulary.relations:
                    return False
                case IsA(cls=iri) if iri not in vocabulary.classes:
                    return False
                case HasProperty(property=iri) if iri not in vocabulary.properties:
                    return False
        return True

    def _values(self, values: Iterable[TypedExpression]) -> bool:
        return all(self._value(part) for value in values for part in values_in(value))

    def _value(self, value: TypedExpression) -> bool:
        if getattr(value.meaning, "name", "") == "_":
            return True
        properties = (part.property for part in walk(value.meaning) if isinstance(part, PropertyOf))
        return value.type != UNKNOWN and all(iri in self._program.vocabulary.properties for iri in properties)


def _is_post(requirement: Requirement) -> bool:
    """Whether it is no post, or one with definite effects."""
    if requirement.kind != "post" or requirement.sensed:
        return True
    return not any(isinstance(effect, NoEffect) for effect in effects_of(requirement.condition))
