"""trees/: behaviour trees in the XML of BehaviorTree.CPP, version 4.

A file per skill that has a compound implementation, and per task written by hand. Each can be loaded by itself: it
holds the trees of all skills it calls and declares every node it uses, with the names behind its ID: those of the
skill, of the implementation (empty: the description) and of what is meant there. Its main tree only passes on what the
skill requires, from the blackboard, and the defaults of what it does not. Nodes other than trees are written by their
ID alone: version 4.7 takes no `<Condition ID=..>` in a ReactiveSequence.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from xml.etree.ElementTree import Element, indent, tostring

from skillc_compiler.emit.bt.calls import is_tree, reached
from skillc_compiler.emit.bt.depth import cut
from skillc_compiler.emit.bt.model import Model
from skillc_compiler.emit.bt.names import Names, legal, legal_text
from skillc_compiler.emit.bt.nodes import Body, started
from skillc_compiler.emit.bt.rules import verified
from skillc_compiler.emit.bt.skills import fixed_tree, implementation_tree, main_tree, skill_tree
from skillc_compiler.emit.headers import XML_DECLARATION
from skillc_model.reading import calls_in
from skillc_model.skills import Compound, Skill, SkillLibrary, Task
from skillc_model.tree import Node


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return a file for each skill with a compound implementation, and for each task that is written by hand."""
    names, chosen = _names(library), _chosen(library)
    files = {}
    for _, skill in sorted(library.skills.items()):
        if any(isinstance(each.body, Compound) for each in library.implementations_of(skill.name)):
            files[f"trees/{legal(skill.name)}.xml"] = _skill_file(skill, library, names, chosen)
    for _, task in sorted(library.tasks.items()):
        if task.body is not None:
            files[f"trees/{names.of('', 'task', task.name)}.xml"] = _task_file(task, task.body, library, names, chosen)
    return files


def _names(library: SkillLibrary) -> Names:
    """Return names in which skills and implementations come first, so that they are the same in every file."""
    names = Names()
    for skill in sorted(library.skills):
        names.of(skill)
    for _, implementation in sorted(library.implementations.items()):
        names.of(implementation.skill, implementation.name)
    return names


def _skill_file(skill: Skill, library: SkillLibrary, names: Names, chosen: Set[tuple[str, str]]) -> str:
    model = Model()
    skills = [skill, *(library.skills[name] for name in sorted(reached([skill.name], library) - {skill.name}))]
    main = main_tree(library, names, model, skill)
    return _document(
        [main, *(tree for each in skills for tree in _trees(each, library, names, model, chosen))], names, model
    )


def _task_file(task: Task, node: Node, library: SkillLibrary, names: Names, chosen: Set[tuple[str, str]]) -> str:
    model = Model()
    path = ("", "task", task.name)
    identity = names.of(*path)
    model.declare("SubTree", identity, path, (), task.doc)
    body = Body(library, names, model, path)
    tree = Element("BehaviorTree", ID=identity, _description=str(task.source))
    tree.append(started(body, [body.node(node)]))
    called = reached([each.skill for each in calls_in(node)], library)
    others = [each for name in sorted(called) for each in _trees(library.skills[name], library, names, model, chosen)]
    return _document([tree, *others], names, model)


def _trees(
    skill: Skill, library: SkillLibrary, names: Names, model: Model, chosen: Set[tuple[str, str]]
) -> Iterator[Element]:
    if not is_tree(library, skill):
        return
    yield skill_tree(library, names, model, skill)
    for each in library.implementations_of(skill.name):
        if (skill.name, each.name) in chosen:
            yield fixed_tree(library, names, model, skill, each)
        if isinstance(each.body, Compound):
            yield implementation_tree(library, names, model, each)


def _chosen(library: SkillLibrary) -> set[tuple[str, str]]:
    """Return the implementations that some call of the library chooses itself, each with its skill."""
    bodies = [each.body.node for each in library.implementations.values() if isinstance(each.body, Compound)]
    bodies += [each.body for each in library.tasks.values() if each.body is not None]
    calls = [each for body in bodies for each in calls_in(body)]
    return {(each.skill, each.implementation) for each in calls if each.implementation is not None}


def _document(trees: list[Element], names: Names, model: Model) -> str:
    """Return the file whose main tree is the first; TreeRefused if BehaviorTree.CPP would misread it."""
    root = Element("root", BTCPP_format="4", main_tree_to_execute=trees[0].get("ID", ""))
    root.extend([part for tree in trees for part in cut(tree, names, model)])
    root.append(model.element())
    for element in root.iter():
        element.attrib.update({name: legal_text(value) for name, value in element.attrib.items()})
        element.text = element.text and legal_text(element.text)
    indent(root)
    return XML_DECLARATION + tostring(verified(root), encoding="unicode") + "\n"
