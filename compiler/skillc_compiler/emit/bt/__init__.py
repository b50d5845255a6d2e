"""Emits trees/: behaviour trees in the XML format of BehaviorTree.CPP 4.

There is one file per skill with a compound implementation and per task with a body. Each file can be loaded on its own:
it contains the trees of all skills it calls and declares every node it uses, with the names behind its ID: skill,
implementation (empty: the description) and part. Its main tree passes the skill its required parameters from the
blackboard and the defaults of the others. Nodes other than trees are written with their ID as the tag, since version
4.7 does not accept `<Condition ID=..>` in a ReactiveSequence.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from xml.etree.ElementTree import Element, indent, tostring

from skillc_compiler.emit.bt.body import bind_parameters
from skillc_compiler.emit.bt.calls import is_tree, reachable_skills
from skillc_compiler.emit.bt.model import Model
from skillc_compiler.emit.bt.names import NodeIds, to_identifier, to_xml_text
from skillc_compiler.emit.bt.nodes import NodeWriter, with_start_scripts
from skillc_compiler.emit.bt.rules import check_file
from skillc_compiler.emit.bt.skills import make_fixed_tree, make_implementation_tree, make_main_tree, make_skill_tree
from skillc_compiler.emit.headers import XML_DECLARATION
from skillc_model.skills import Compound, Skill, SkillLibrary, Task
from skillc_model.traversal import find_calls
from skillc_model.tree import Node


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return a file for each skill with a compound implementation and each task with a body."""
    names, chosen = _names(library), _chosen(library)
    files = {}
    for _, skill in sorted(library.skills.items()):
        if any(isinstance(each.body, Compound) for each in library.implementations_of(skill.name)):
            files[f"trees/{to_identifier(skill.name)}.xml"] = _skill_file(skill, library, names, chosen)
    for _, task in sorted(library.tasks.items()):
        if task.body is not None:
            files[f"trees/{names.of('', 'task', task.name)}.xml"] = _task_file(task, task.body, library, names, chosen)
    return files


def _names(library: SkillLibrary) -> NodeIds:
    """Return IDs with skills and implementations registered first, so that theirs are the same in every file."""
    names = NodeIds()
    for skill in sorted(library.skills):
        names.of(skill)
    for _, implementation in sorted(library.implementations.items()):
        names.of(implementation.skill, implementation.name)
    return names


def _skill_file(skill: Skill, library: SkillLibrary, names: NodeIds, chosen: Set[tuple[str, str]]) -> str:
    model = Model()
    skills = [skill, *(library.skills[name] for name in sorted(reachable_skills([skill.name], library) - {skill.name}))]
    main = make_main_tree(library, names, model, skill)
    return _document(
        [main, *(tree for each in skills for tree in _trees(each, library, names, model, chosen))], names, model
    )


def _task_file(task: Task, node: Node, library: SkillLibrary, names: NodeIds, chosen: Set[tuple[str, str]]) -> str:
    model = Model()
    path = ("", "task", task.name)
    identity = names.of(*path)
    model.declare("SubTree", identity, path, (), task.doc)
    body = NodeWriter(library, names, model, path, bound=bind_parameters(task.parameters))
    tree = Element("BehaviorTree", ID=identity, _description=str(task.source))
    tree.append(with_start_scripts(body, [body.node(node)]))
    called = reachable_skills([each.skill for each in find_calls(node)], library)
    others = [each for name in sorted(called) for each in _trees(library.skills[name], library, names, model, chosen)]
    return _document([tree, *others], names, model)


def _trees(
    skill: Skill, library: SkillLibrary, names: NodeIds, model: Model, chosen: Set[tuple[str, str]]
) -> Iterator[Element]:
    if not is_tree(library, skill):
        return
    yield make_skill_tree(library, names, model, skill)
    for each in library.implementations_of(skill.name):
        if (skill.name, each.name) in chosen:
            yield make_fixed_tree(library, names, model, skill, each)
        if isinstance(each.body, Compound):
            yield make_implementation_tree(library, names, model, each)


def _chosen(library: SkillLibrary) -> set[tuple[str, str]]:
    """Return the (skill, implementation) pairs that some call of the library selects explicitly."""
    bodies = [each.body.node for each in library.implementations.values() if isinstance(each.body, Compound)]
    bodies += [each.body for each in library.tasks.values() if each.body is not None]
    calls = [each for body in bodies for each in find_calls(body)]
    return {(each.skill, each.implementation) for each in calls if each.implementation is not None}


def _document(trees: list[Element], names: NodeIds, model: Model) -> str:
    """Return the file whose main tree is the first; InvalidTree if it breaks a rule of BehaviorTree.CPP."""
    root = Element("root", BTCPP_format="4", main_tree_to_execute=trees[0].get("ID", ""))
    root.extend([part for tree in trees for part in split_deep_tree(tree, names, model)])
    root.append(model.element())
    for element in root.iter():
        element.attrib.update({name: to_xml_text(value) for name, value in element.attrib.items()})
        element.text = element.text and to_xml_text(element.text)
    indent(root)
    return XML_DECLARATION + tostring(check_file(root), encoding="unicode") + "\n"


DEEPEST = 200


def split_deep_tree(tree: Element, names: NodeIds, model: Model) -> list[Element]:
    """Return the tree and the subtrees split off where it is too deep; they share its blackboard."""
    parts = [tree]
    for part in parts:
        for parent, index in _too_deep(part):
            path = ("", "part", tree.get("ID", ""), str(len(parts)))
            identity = names.of(*path)
            model.declare("SubTree", identity, path, (), f"A part of {tree.get('ID')} that is nested too deep in it.")
            parts.append(Element("BehaviorTree", ID=identity))
            parts[-1].append(parent[index])
            parent[index] = Element("SubTree", ID=identity, _autoremap="true")
    return parts


def _too_deep(tree: Element) -> list[tuple[Element, int]]:
    """Return the nodes to split off, each as its parent and its index among the children."""
    level = [tree]
    for _ in range(DEEPEST - 1):
        level = [child for parent in level for child in parent]
    return [(parent, index) for parent in level for index, child in enumerate(parent) if len(child)]
