"""Calls of skills: a skill that infers, tests or chooses anything is a tree, any other skill is a single action."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.body import (
    ParameterBinding,
    TreeWriter,
    join_steps,
    make_leaf,
    pointer,
    run_after,
    with_children,
)
from skillc_compiler.emit.bt.model import Kind, Port
from skillc_compiler.emit.bt.names import port_name
from skillc_compiler.emit.bt.ports import (
    action_ports,
    call_port,
    default_attributes,
    format_default,
    forward_parameters,
    port_type,
    tree_ports,
    whole_ports,
)
from skillc_dsl.position import Position
from skillc_model.skills import Compound, Implementation, Parameter, Skill, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_model.tree import Call, Node
from skillc_rdf.vocabulary.closure import reachable


def is_tree(library: SkillLibrary, skill: Skill) -> bool:
    """Whether a skill is a tree; otherwise it is a single action."""
    implementations = library.implementations_of(skill.name)
    inferred = any(each.direction == "infer" for each in skill.parameters)
    return inferred or len(implementations) > 1 or any(_demands(each, skill) for each in implementations)


def _demands(implementation: Implementation, skill: Skill) -> bool:
    """Whether an implementation does more than run a primitive, which applies its postconditions itself."""
    described = {each.name: each.type for each in skill.parameters}
    narrower = any(described.get(each.name, each.type) != each.type for each in implementation.parameters)
    sensed = any(post.sensed for post in implementation.post)
    tested = narrower or sensed or bool(implementation.pre or implementation.hold)
    return tested or isinstance(implementation.body, Compound)


def may_break_hold(library: SkillLibrary, node: Node) -> bool:
    """Whether a skill below the node has a hold condition."""
    names = reachable_skills([each.skill for each in find_calls(node)], library)
    return any(each.hold for name in names for each in library.implementations_of(name))


def reachable_skills(start: Sequence[str], library: SkillLibrary) -> set[str]:
    """Return these skills and all that they call, directly or indirectly."""

    def called(name: str) -> Iterator[str]:
        bodies = (each.body for each in library.implementations_of(name))
        nodes = (body.node for body in bodies if isinstance(body, Compound))
        return (each.skill for node in nodes for each in find_calls(node))

    return reachable(start, called)


def make_call(writer: TreeWriter, written: Call) -> Element:
    """Return the call of a skill, after the nodes that compute its arguments."""
    skill = writer.library.skills[written.skill]
    before, attributes = _arguments(writer, written, skill)
    outputs, converted = _outputs(writer, written, skill)
    attributes |= outputs
    if not is_tree(writer.library, skill):
        ports = action_ports(skill.parameters)
        single = make_call_node(writer, "Action", (skill.name,), ports, skill.doc, attributes, written.source)
        return join_steps([*before, single, *converted])
    path: tuple[str, ...] = (skill.name,)
    described = skill.parameters
    if written.implementation is not None:
        path = (skill.name, "", "only", written.implementation)
        described = writer.library.implementations[f"{skill.name}.{written.implementation}"].parameters
    attributes = {**default_attributes(described), **attributes}
    ports = tree_ports(described)
    tree = make_call_node(writer, "SubTree", path, ports, skill.doc, attributes, written.source)
    return join_steps([*before, tree, *converted])


def make_run(writer: TreeWriter, implementation: Implementation) -> Element:
    """Return the node that runs an implementation in the tree of its skill, on the entries of that tree."""
    kind: Kind = "SubTree" if isinstance(implementation.body, Compound) else "Action"
    path, ports = (implementation.skill, implementation.name), action_ports(implementation.parameters)
    attributes = forward_parameters(implementation.parameters)
    return make_call_node(writer, kind, path, ports, implementation.doc, attributes, implementation.source)


def make_scoped(writer: TreeWriter, written: Call, child: Callable[[], Element]) -> Element:
    """Return the child in a decorator that runs a scoped skill first and undoes its setup however the child ends."""
    skill = writer.library.skills[written.skill]
    before, attributes = _arguments(writer, written, skill)
    outputs, converted = _outputs(writer, written, skill)
    ports = whole_ports(skill.parameters)
    path = ("", "With", skill.name)
    around = make_call_node(writer, "Decorator", path, ports, skill.doc, attributes | outputs, written.source)
    return run_after(before, with_children(around, run_after(converted, child())))


def make_call_node(
    writer: TreeWriter,
    kind: Kind,
    path: tuple[str, ...],
    ports: Sequence[Port],
    doc: str,
    attributes: Mapping[str, str],
    source: Position,
) -> Element:
    """Declare and return a node that runs a skill or an implementation."""
    identity = writer.names.of(*path)
    writer.model.declare(kind, identity, path, ports, doc)
    if kind == "SubTree":
        return make_leaf("SubTree", {"ID": identity, **attributes}, source)
    return make_leaf(identity, attributes, source)


def _arguments(writer: TreeWriter, written: Call, skill: Skill) -> tuple[list[Element], dict[str, str]]:
    """Return the nodes that compute arguments, and the attributes of the call; defaults that ports lack are passed."""
    before: list[Element] = []
    attributes: dict[str, str] = {}
    parameters: dict[str, Parameter] = {each.name: each for each in skill.parameters}
    odd = {p.name: p.default for p in skill.parameters if p.default is not None and format_default(p) is None}
    for name, expression in {**odd, **written.arguments}.items():
        parameter = parameters[name]
        attributes[call_port(parameter)] = writer.value(name, expression, before, port_type(parameter.type))
    return before, attributes


def _outputs(writer: TreeWriter, written: Call, skill: Skill) -> tuple[dict[str, str], list[Element]]:
    """Return the attributes for outputs, and the nodes that convert them; unnamed outputs get unused entries."""
    outputs = [each for each in skill.parameters if each.direction == "out"]
    if written.out is None or len(outputs) != 1:
        return {port_name(each.name): pointer(writer.entry(each.name)) for each in outputs}, []
    (output,) = outputs
    kind, target = port_type(output.type), writer.bind(written.out, output.type)
    if None in (kind, target.type) or kind == target.type:
        return {port_name(output.name): pointer(target.entry)}, []
    found = ParameterBinding(writer.entry(written.out), kind)
    return {port_name(output.name): pointer(found.entry)}, [writer.converted(written.out, found, target)]
