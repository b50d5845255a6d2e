"""A skill as a tree: infer, test preconditions, run an implementation under hold conditions, test postconditions."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.body import bind_parameters, join_steps, pointer, with_children
from skillc_compiler.emit.bt.calls import make_call, make_run
from skillc_compiler.emit.bt.model import Model
from skillc_compiler.emit.bt.names import NodeIds, given_port, port_name
from skillc_compiler.emit.bt.nodes import NodeWriter, with_start_scripts
from skillc_compiler.emit.bt.ports import forward_parameters, inferring_ports, port_type
from skillc_model.conditions import Expression, IsA, Variable
from skillc_model.rewriting import ALWAYS
from skillc_model.skills import Compound, Implementation, Outcome, Post, Requirement, Skill, SkillLibrary
from skillc_model.tree import Call
from skillc_rdf.vocabulary.types import ClassType

DESCRIPTION = ""
"""The name of the description in a path of names, in place of an implementation's."""


def make_main_tree(library: SkillLibrary, names: NodeIds, model: Model, skill: Skill) -> Element:
    """Return the tree that runs a skill on its own: parameters without a default are read from the blackboard."""
    path = (skill.name, DESCRIPTION, "main")
    arguments: dict[str, Expression] = {
        each.name: Variable(each.name) for each in skill.parameters if each.direction != "out" and each.default is None
    }
    body = NodeWriter(library, names, model, path, bound=bind_parameters(skill.parameters))
    running = make_call(body, Call(skill.name, None, arguments, None, skill.source))
    return _tree(body, running, str(skill.source), skill.doc)


def make_skill_tree(library: SkillLibrary, names: NodeIds, model: Model, skill: Skill) -> Element:
    """Return the tree of a description, which runs the first applicable implementation."""
    body = NodeWriter(library, names, model, (skill.name,), bound=bind_parameters(skill.parameters))
    steps = _guarded(body, skill, library.implementations_of(skill.name))
    return _tree(body, steps, str(skill.source))


def make_fixed_tree(
    library: SkillLibrary, names: NodeIds, model: Model, skill: Skill, chosen: Implementation
) -> Element:
    """Return the tree of a description for callers that have chosen the implementation."""
    owner = (skill.name, DESCRIPTION, "only", chosen.name)
    body = NodeWriter(library, names, model, owner, bound=bind_parameters(skill.parameters))
    return _tree(body, _guarded(body, skill, [chosen]), str(skill.source))


def make_implementation_tree(
    library: SkillLibrary, names: NodeIds, model: Model, implementation: Implementation
) -> Element:
    """Return the tree of a compound implementation: its lets, its body, then the outputs that it computes."""
    if not isinstance(implementation.body, Compound):
        raise TypeError(f"{implementation.name} has no tree")
    owner, bound = (implementation.skill, implementation.name), bind_parameters(implementation.parameters)
    body = NodeWriter(library, names, model, owner, posts=implementation.post, bound=bound)
    steps = [body.evaluate(each.value, port_name(each.name)) for each in implementation.lets]
    steps.append(body.node(implementation.body.node))
    types = {each.name: port_type(each.type) for each in implementation.parameters}
    steps += [body.evaluate(each.value, port_name(each.name), types[each.name]) for each in implementation.outputs]
    return _tree(body, with_start_scripts(body, steps), str(implementation.source))


def _tree(body: NodeWriter, root: Element, source: str, doc: str | None = None) -> Element:
    """Return the tree, declared here if `doc` is given: a tree that is called is declared by its callers."""
    identity = body.names.of(*body.owner)
    if doc is not None:
        body.model.declare("SubTree", identity, body.owner, (), doc)
    return with_children(Element("BehaviorTree", ID=identity, _description=source), root)


def _guarded(body: NodeWriter, skill: Skill, implementations: Sequence[Implementation]) -> Element:
    choice = _choice(body, skill, implementations)
    described = (skill.name, DESCRIPTION)
    return join_steps(
        [
            *_inference(body, skill),
            *(_required(body, (*described, "pre"), each) for each in skill.pre),
            _held(body, described, skill.hold, choice),
            *(_required(body, (*described, "post"), each) for each in skill.post if each.condition != ALWAYS),
            *_outcomes(body, described, skill),
        ]
    )


def _outcomes(body: NodeWriter, path: tuple[str, ...], skill: Skill) -> list[Element]:
    """Return that an outcome has come true; bodies tell which by their own conditions."""
    if not skill.outcomes:
        return []
    return [with_children(Element("Fallback"), *(_required(body, (*path, "outcome"), each) for each in skill.outcomes))]


def _inference(body: NodeWriter, skill: Skill) -> list[Element]:
    inferred = [each for each in skill.parameters if each.direction == "infer"]
    if not inferred:
        return []
    parameters = [each for each in skill.parameters if each.direction in ("in", "infer")]
    path = (skill.name, DESCRIPTION, "infer")
    doc = f"Finds {', '.join(each.name for each in inferred)} in the world model by the preconditions, unless given."
    body.model.declare("Action", body.names.of(*path), path, inferring_ports(parameters), doc)
    callers = {given_port(each.name): pointer(given_port(each.name)) for each in inferred}
    return [Element(body.names.of(*path), {**forward_parameters(parameters), **callers})]


def _required(body: NodeWriter, path: tuple[str, ...], requirement: Requirement | Post | Outcome) -> Element:
    return body.condition((*path, requirement.label), requirement.condition, requirement.text, requirement.source)


def _held(body: NodeWriter, path: tuple[str, ...], holds: Sequence[Requirement], inner: Element) -> Element:
    if not holds:
        return inner
    return with_children(
        Element("ReactiveSequence"), *(_required(body, (*path, "hold"), each) for each in holds), inner
    )


def _choice(body: NodeWriter, skill: Skill, implementations: Sequence[Implementation]) -> Element:
    """Return the choice among implementations; the next is tried after a failure only if the skill has `fallback`."""
    options = [(_demands(body, each, skill), _run(body, each, skill)) for each in implementations]
    if skill.fallback and len(options) > 1:
        return _with_fallback(body, skill, options)
    chosen = Element("AlwaysFailure")
    for demands, option in reversed(options):
        chosen = with_children(Element("IfThenElse"), join_steps(demands), option, chosen) if demands else option
    return chosen


def _with_fallback(body: NodeWriter, skill: Skill, options: Sequence[tuple[list[Element], Element]]) -> Element:
    """Return a fallback over the implementations; preconditions are tested again after a failure."""
    choice = Element("Fallback")
    for number, (demands, option) in enumerate(options):
        again = [_required(body, (skill.name, DESCRIPTION, "pre"), each) for each in skill.pre] if number else []
        choice.append(join_steps([*again, *demands, option]))
    return choice


def _run(body: NodeWriter, implementation: Implementation, skill: Skill) -> Element:
    own = [each for each in implementation.hold if each not in skill.hold]
    return _held(body, (skill.name, implementation.name), own, make_run(body, implementation))


def _demands(body: NodeWriter, implementation: Implementation, skill: Skill) -> list[Element]:
    """Return the tests of the refined types and the preconditions that the implementation adds."""
    owner = (skill.name, implementation.name)
    described = {each.name: each.type for each in skill.parameters}
    tests = []
    for each in implementation.parameters:
        if isinstance(each.type, ClassType) and each.type != described.get(each.name, each.type):
            text = f"{each.name} is {body.library.vocabulary.short(each.type.iri)}"
            condition = IsA(Variable(each.name), each.type.iri)
            tests.append(body.condition((*owner, "type", each.name), condition, text, each.source))
    own = [each for each in implementation.pre if each not in skill.pre]
    return tests + [_required(body, (*owner, "pre"), each) for each in own]
