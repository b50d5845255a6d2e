"""A skill as a tree: look up what is inferred, test, run an implementation while the hold conditions hold, test."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt_names import port
from skillc_compiler.emit.bt_nodes import Body
from skillc_compiler.emit.bt_ports import action_ports, default_text, passed_on
from skillc_compiler.library.conditions import Expression, IsA, Variable
from skillc_compiler.library.skills import Compound, Implementation, Post, Requirement, Skill
from skillc_compiler.library.tree import Call
from skillc_compiler.library.vocabulary import ClassType


def skill_tree(body: Body, skill: Skill) -> Element:
    """Return the tree of a description, which runs the first implementation that fits."""
    choice = _choice(body, skill, body.library.implementations_of(skill.name))
    return _tree(body.names.of(skill.name), _guarded(body, skill, choice), str(skill.source))


def fixed_tree(body: Body, skill: Skill, implementation: Implementation) -> Element:
    """Return the tree of a description for callers who have chosen the implementation."""
    identity = body.names.of(skill.name, "only", implementation.name)
    return _tree(identity, _guarded(body, skill, _choice(body, skill, [implementation])), str(skill.source))


def main_tree(body: Body, skill: Skill) -> Element:
    """Return the tree that runs a skill by itself: what has a default gets it, the rest is read from the blackboard."""
    arguments: dict[str, Expression] = {
        each.name: Variable(each.name) for each in skill.parameters if default_text(each) is None
    }
    call = Call(skill.name, None, arguments, None, skill.source)
    return _tree(body.names.of(*body.owner), [body.call(call)], str(skill.source))


def implementation_tree(body: Body, implementation: Implementation) -> Element:
    """Return the tree of a compound implementation: its lets, then its body."""
    if not isinstance(implementation.body, Compound):
        raise TypeError(f"{implementation.name} has no tree")
    steps = [body.evaluate(each.value, port(each.name)) for each in implementation.lets]
    steps.append(body.node(implementation.body.node))
    return _tree(body.names.of(implementation.skill, implementation.name), steps, str(implementation.source))


def _tree(identity: str, steps: Sequence[Element], source: str) -> Element:
    tree = Element("BehaviorTree", ID=identity, _description=source)
    if len(steps) == 1:
        tree.append(steps[0])
    else:
        sequence = Element("Sequence")
        sequence.extend(steps)
        tree.append(sequence)
    return tree


def _guarded(body: Body, skill: Skill, choice: Element) -> list[Element]:
    return [
        *_inference(body, skill),
        *(_required(body, "pre", each) for each in skill.pre),
        _held(body, skill.hold, choice),
        *(_required(body, "post", each) for each in skill.post),
    ]


def _inference(body: Body, skill: Skill) -> list[Element]:
    inferred = [each for each in skill.parameters if each.direction == "infer"]
    if not inferred:
        return []
    parameters = [each for each in skill.parameters if each.direction in ("in", "infer")]
    identity = body.names.of(skill.name, "infer")
    doc = f"Finds {', '.join(each.name for each in inferred)} in the world model by the preconditions."
    body.model.declare("Action", identity, action_ports(parameters), doc)
    return [Element("Action", {"ID": identity, **passed_on(parameters)})]


def _required(body: Body, kind: str, requirement: Requirement | Post) -> Element:
    path = (*body.owner, kind, requirement.label)
    return body.condition(path, requirement.condition, requirement.text, requirement.source)


def _held(body: Body, holds: Sequence[Requirement], inner: Element) -> Element:
    if not holds:
        return inner
    guarded = Element("ReactiveSequence")
    guarded.extend([*(_required(body, "hold", each) for each in holds), inner])
    return guarded


def _choice(body: Body, skill: Skill, implementations: Sequence[Implementation]) -> Element:
    """Return the choice among implementations; the next is tried after a failure only where the skill says so."""
    options = [(_demands(body, each, skill), _run(body, each, skill)) for each in implementations]
    if skill.fallback and len(options) > 1:
        choice = Element("Fallback")
        choice.extend(_sequence([*demands, run]) for demands, run in options)
        return choice
    chosen = Element("AlwaysFailure")
    for demands, run in reversed(options):
        if not demands:
            chosen = run
            continue
        branch = Element("IfThenElse")
        branch.extend([_sequence(demands), run, chosen])
        chosen = branch
    return chosen


def _sequence(steps: Sequence[Element]) -> Element:
    if len(steps) == 1:
        return steps[0]
    sequence = Element("Sequence")
    sequence.extend(steps)
    return sequence


def _run(body: Body, implementation: Implementation, skill: Skill) -> Element:
    own = [each for each in implementation.hold if each not in skill.hold]
    return _held(
        Body(body.library, body.names, body.model, (skill.name, implementation.name)), own, body.run(implementation)
    )


def _demands(body: Body, implementation: Implementation, skill: Skill) -> list[Element]:
    """Return the tests of the refined types and of the preconditions that the implementation adds."""
    owner = (skill.name, implementation.name)
    described = {each.name: each.type for each in skill.parameters}
    tests = []
    for each in implementation.parameters:
        if isinstance(each.type, ClassType) and each.type != described.get(each.name, each.type):
            text = f"{each.name} is {body.library.vocabulary.short(each.type.iri)}"
            condition = IsA(Variable(each.name), each.type.iri)
            tests.append(body.condition((*owner, "type", each.name), condition, text, each.source))
    own = [each for each in implementation.pre if each not in skill.pre]
    return tests + [body.condition((*owner, "pre", each.label), each.condition, each.text, each.source) for each in own]
