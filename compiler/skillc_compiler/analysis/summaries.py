"""What a skill may write, independent of its caller: in any case, when it fails, and undeclared when it succeeds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from skillc_compiler.analysis.applied import applied_posts
from skillc_compiler.analysis.binding import call_requirements, definite_effects
from skillc_compiler.analysis.caller_terms import hide_names, in_caller_terms
from skillc_compiler.analysis.exclusive_use import ExclusiveUse
from skillc_compiler.analysis.initial_state import declare_names, initial_state, requirements_of
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.apply_effects import apply_effects
from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.possible import possible_writes
from skillc_compiler.analysis.knowledge.writes import (
    NO_WRITES,
    OnceWrite,
    OutputWrite,
    PropertyWrite,
    RelationWrite,
    Write,
    with_unknown_value,
    write_of,
)
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, Requirement, Skill, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Condition, Individual, Literal, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import free_variables


class HoldInside(msgspec.Struct, frozen=True):
    """A condition that has to hold while a part of a body runs, and its text where it was written."""

    condition: Condition
    text: str


class WriteSummaries:
    """The possible writes of each skill and node, computed once; recursion adds nothing."""

    def __init__(self, program: Program, axioms: CanonicalAxioms) -> None:
        self._program = program
        self._axioms = axioms
        self.uses = ExclusiveUse(program)
        self._whole: dict[str, frozenset[Write]] = {}
        self._steps: dict[int, frozenset[Write]] = {}
        self._kept: dict[str, bool] = {}
        self._holding: dict[str, bool] = {}
        self._names: dict[str, frozenset[str]] = {}
        self._early: dict[str, frozenset[Write]] = {}
        self._holds_inside: dict[str, frozenset[HoldInside]] = {}
        self._scoped: dict[str, frozenset[Write]] = {}

    def all_writes(self, implementation: Implementation) -> frozenset[Write]:
        """Return what the implementation may write before it ends, in any way."""
        if implementation.key not in self._whole:
            self._whole[implementation.key] = NO_WRITES
            self._whole[implementation.key] = frozenset(self._writes_of(implementation))
        return self._whole[implementation.key]

    def writes_on_failure(self, implementation: Implementation) -> frozenset[Write]:
        """Return what may have been written when the implementation did not succeed.

        A failed primitive has written what it measured, and its effects only if its own postconditions failed.
        """
        if isinstance(implementation.body, TypedNode):
            return self.all_writes(implementation)
        if implementation.key not in self._kept:
            self._kept[implementation.key] = self._keeps_promises(implementation)
        return NO_WRITES if self._kept[implementation.key] else self.all_writes(implementation)

    def _keeps_promises(self, implementation: Implementation) -> bool:
        """Whether a primitive's posts hold once they are written, so that writing them is the last thing it does."""
        posts = requirements_of(implementation, "post")
        if _is_open(implementation.skill) or any(post.sensed for post in posts):
            return False
        types = AliasTypes(self._program.vocabulary, self._axioms)
        declare_names(types, implementation)
        state = apply_effects(
            types, initial_state(types, implementation), [effect for _, effect in definite_effects(posts)]
        )
        return all(evaluate(types, state, post.condition.meaning) for post in posts)

    def writes_of_call(self, call: Call, failing: bool = False) -> frozenset[Write]:
        """Return what a call may write, in the caller's terms; an inferred individual may be any that fits."""
        if call.skill is None:
            return NO_WRITES
        candidates = self._program.candidates(call)
        each = (self.writes_on_failure(one) if failing else self.all_writes(one) for one in candidates)
        found = frozenset[Write]().union(*each) if candidates else _writes_alone(call.skill, failing)
        return in_caller_terms(call, found)

    def writes_of_node(self, node: TypedNode, implementation: Implementation | None) -> frozenset[Write]:
        """Return what a node may write."""
        if id(node) not in self._steps:
            self._steps[id(node)] = frozenset(self._writes_of_node(node, implementation))
        return self._steps[id(node)]

    def early_writes(self, implementation: Implementation) -> frozenset[Write]:
        """Return what the implementation may write while a part of it has still to run."""
        if implementation.key not in self._early:
            self._early[implementation.key] = NO_WRITES
            if isinstance(implementation.body, TypedNode):
                visible = [p.name for p in implementation.parameters if p.direction != "out"]
                found = self._early_writes_of_node(implementation.body, implementation)
                facts = (write for write in found if isinstance(write, RelationWrite | PropertyWrite))
                self._early[implementation.key] = hide_names(facts, visible)
        return self._early[implementation.key]

    def early_writes_of_call(self, call: Call) -> frozenset[Write]:
        """Return what a call may write before it ends, in the caller's terms."""
        candidates = self._program.candidates(call) if call.skill is not None else ()
        return in_caller_terms(call, frozenset(write for one in candidates for write in self.early_writes(one)))

    def possible_writes_of(self, call: Call) -> frozenset[Write]:
        """Return what a call may have written when it succeeds, as its skill says, in the caller's terms."""
        said = possible_writes(call.skill.requirements) if call.skill is not None else ()
        return in_caller_terms(call, frozenset(map(with_unknown_value, said)))

    def _early_writes_of_node(self, node: TypedNode, of: Implementation) -> frozenset[Write]:
        """Return what a node may write while a part of it has still to run."""
        written = node.written
        if isinstance(written, s.CallSkill) and node.call is not None:
            return self.early_writes_of_call(node.call)
        several = isinstance(written, s.While | s.For) or (isinstance(written, s.Decorator) and written.row.repeats)
        if several or (isinstance(written, s.Block) and (written.kind.startswith(("par", "reactive")))):
            return self.writes_of_node(node, of)
        opened = self.writes_of_call(node.call) if node.call is not None else NO_WRITES
        before = node.children if isinstance(written, s.Finally) else node.children[:-1]
        last = (*node.children[-1:], *node.orelse[-1:])
        whole = (self.writes_of_node(each, of) for each in (*before, *node.orelse[:-1]))
        in_last = (self._early_writes_of_node(each, of) for each in last)
        return opened.union(*whole, *in_last)

    def holds_inside(self, implementation: Implementation) -> frozenset[HoldInside]:
        """Return what has to hold while parts of a body run, as far as it is on the parameters of its skill."""
        if implementation.key not in self._holds_inside:
            self._holds_inside[implementation.key] = frozenset()
            calls = calls_in(implementation.body) if isinstance(implementation.body, TypedNode) else ()
            names = {p.name for p in implementation.skill.parameters}
            found = (hold for call in calls for hold in self.holds_of_call(call))
            self._holds_inside[implementation.key] = frozenset(
                hold for hold in found if free_variables(hold.condition) <= names
            )
        return self._holds_inside[implementation.key]

    def holds_of_call(self, call: Call) -> Iterator[HoldInside]:
        """Yield what has to hold while a call, or a part of it, runs, as far as the caller has names for it."""
        passed = ((argument.name.text, argument.value.meaning) for argument in call.values)
        values = {name: value for name, value in passed if isinstance(value, Variable | Individual | Literal)}
        own = (HoldInside(each.condition.meaning, each.text) for each in call_requirements(self._program, call, "hold"))
        candidates = self._program.candidates(call) if call.skill is not None else ()
        for hold in (*own, *(hold for one in candidates for hold in self.holds_inside(one))):
            if free_variables(hold.condition) <= values.keys():
                yield HoldInside(substitute(hold.condition, values), hold.text)

    def scoped_writes(self, call: Call) -> frozenset[Write]:
        """Return the writes of scoped skills that remain after the call, until an enclosing `with` ends."""
        if call.skill is None:
            return NO_WRITES
        if "scoped" in call.skill.flags:
            return self.writes_of_call(call)
        inner = (write for one in self._program.candidates(call) for write in self.scoped_writes_inside(one))
        return in_caller_terms(call, frozenset(inner))

    def scoped_writes_inside(self, of: Implementation) -> frozenset[Write]:
        """Return the writes of scoped skills that remain after an implementation has run, in its own terms."""
        if of.key not in self._scoped:
            self._scoped[of.key] = NO_WRITES
            calls = calls_in(of.body) if isinstance(of.body, TypedNode) else ()
            inner = (write for each in calls for write in self.scoped_writes(each))
            self._scoped[of.key] = hide_names(inner, [p.name for p in of.skill.parameters])
        return self._scoped[of.key]

    def skills_run_by(self, call: Call) -> frozenset[str]:
        """Return the names of all skills that a call may run."""
        if call.skill is None:
            return frozenset()
        if call.skill.name not in self._names:
            self._names[call.skill.name] = frozenset({call.skill.name})
            known = self._program.implementations_of.get(call.skill.name, ())
            bodies = [one.body for one in known if isinstance(one.body, TypedNode)]
            inner = (self.skills_run_by(each) for body in bodies for each in calls_in(body))
            self._names[call.skill.name] = frozenset({call.skill.name}).union(*inner)
        return self._names[call.skill.name]

    def may_break_hold(self, skill: Skill) -> bool:
        """Whether an execution of the skill may end because a hold broke or a `verify` line was violated."""
        if skill.name not in self._holding:
            self._holding[skill.name] = False
            self._holding[skill.name] = self._may_break(skill)
        return self._holding[skill.name]

    def _may_break(self, skill: Skill) -> bool:
        known = self._program.implementations_of.get(skill.name, ())
        holds = any(each.kind == "hold" for one in known for each in (*skill.requirements, *one.requirements))
        watched = any(line.pattern == "never" and line.first.skill is None for one in known for line in one.verify)
        return (
            holds
            or watched
            or any(
                self.may_break_hold(call.skill)
                for one in known
                if isinstance(one.body, TypedNode)
                for call in calls_in(one.body)
                if call.skill is not None
            )
        )

    def _writes_of(self, implementation: Implementation) -> Iterator[Write]:
        if isinstance(implementation.body, TypedNode):
            visible = [p.name for p in implementation.parameters if p.direction != "out"]
            whole = self.writes_of_node(implementation.body, implementation)
            yield from hide_names(
                (write for write in whole if isinstance(write, RelationWrite | PropertyWrite)), visible
            )
            return
        yield from _declared_writes(implementation.skill, requirements_of(implementation, "post"))

    def _writes_of_node(self, node: TypedNode, implementation: Implementation | None) -> Iterator[Write]:
        if node.call is not None:
            yield from self.writes_of_call(node.call)
            if node.call.out is not None:
                yield OutputWrite(node.call.out.text)
        if isinstance(node.written, s.ApplyPosts) and implementation is not None:
            posts = applied_posts(implementation, node)
            yield from (write_of(effect) for _, effect in definite_effects(posts))
        if isinstance(node.written, s.Decorator) and node.written.kind == "once":
            yield OnceWrite(node_key(node))
        for child in (*node.children, *node.orelse):
            yield from self.writes_of_node(child, implementation)


def _is_open(skill: Skill) -> bool:
    """Whether a failure may have written something: a skill that measures, or of which several things may come."""
    return any(each.kind in ("outcome", "possible") or each.sensed for each in skill.requirements) or any(
        each.direction == "out" for each in skill.parameters
    )


def _declared_writes(skill: Skill, posts: Iterable[Requirement]) -> Iterator[Write]:
    """Yield what a skill says that it writes, with these postconditions."""
    for post, effect in definite_effects((*posts, *skill.outcomes)):
        yield with_unknown_value(write_of(effect)) if post.sensed else write_of(effect)
    yield from map(with_unknown_value, possible_writes(skill.requirements))


def _writes_alone(skill: Skill, failing: bool) -> frozenset[Write]:
    """Return what a skill without implementation writes, as a symbolic cell runs it: no effect when it fails."""
    posts = [each for each in skill.requirements if each.kind == "post"]
    return frozenset(_declared_writes(skill, posts)) if not failing or _is_open(skill) else NO_WRITES


def node_key(node: TypedNode) -> int:
    """Return a number that identifies a node in its body."""
    return node.written.span.line * 100_000 + node.written.span.column
