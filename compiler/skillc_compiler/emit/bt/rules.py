"""Rules for files of trees that BehaviorTree.CPP rejects, or silently accepts and runs differently.

Every file is checked before it is written. A broken rule is a bug in the compiler, which converts the authors' names
and values to valid ones.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.names import BUILT_IN
from skillc_rdf.vocabulary.closure import reachable

Children = tuple[int, int]
ANY = 10**6
NODES: Mapping[str, tuple[Children, Mapping[str, str]]] = {
    "Sequence": ((1, ANY), {}),
    "Fallback": ((1, ANY), {}),
    "ReactiveSequence": ((1, ANY), {}),
    "ReactiveFallback": ((1, ANY), {}),
    "Parallel": ((1, ANY), {"success_count": "int", "failure_count": "int"}),
    "IfThenElse": ((2, 3), {}),
    "Inverter": ((1, 1), {}),
    "ForceSuccess": ((1, 1), {}),
    "KeepRunningUntilFailure": ((1, 1), {}),
    "Repeat": ((1, 1), {"num_cycles": "int"}),
    "RetryUntilSuccessful": ((1, 1), {"num_attempts": "int"}),
    "Timeout": ((1, 1), {"msec": "unsigned int"}),
    "Sleep": ((0, 0), {"msec": "unsigned int"}),
    "AlwaysSuccess": ((0, 0), {}),
    "AlwaysFailure": ((0, 0), {}),
    "Script": ((0, 0), {"code": "std::string"}),
    "ScriptCondition": ((0, 0), {"code": "std::string"}),
}
"""The nodes of BehaviorTree.CPP that trees use: their number of children, and their ports with types."""

KINDS: Mapping[str, Children] = {
    "Action": (0, 0),
    "Condition": (0, 0),
    "Control": (1, ANY),
    "Decorator": (1, 1),
    "SubTree": (0, 0),
}
NAMELESS = frozenset({"_autoremap", "_description", "_onSuccess", "_onFailure"})
NUMBER = r"-?((\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|(?i:inf(inity)?|nan(\(\w*\))?))"
LITERALS = {"bool": "true|false", "int": r"-?\d+", "unsigned int": r"\d+", "double": NUMBER, "std::string": "(?s).+"}
BOUNDS = {"int": range(-(2**31), 2**31), "unsigned int": range(2**32)}
IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
POINTER = re.compile(r"\{([A-Za-z][A-Za-z0-9_]*)\}")
RESERVED = frozenset({"ID", "name"})

Ports = dict[str, Element]


class InvalidTree(Exception):
    """A file of trees that BehaviorTree.CPP would reject or misread: a bug in the compiler."""


def check_file(root: Element) -> Element:
    """Return the file; InvalidTree lists every rule that it breaks."""
    broken = list(broken_rules(root))
    if broken:
        raise InvalidTree("; ".join(broken))
    return root


def broken_rules(root: Element) -> Iterator[str]:
    """Yield a sentence for each rule that the file breaks."""
    trees = {tree.get("ID", ""): tree for tree in root.findall("BehaviorTree")}
    models = root.findall("TreeNodesModel/*")
    declared = {each.get("ID", ""): each for each in models}
    yield from _of_file(root, trees)
    yield from (f"two models are called {each}" for each, n in Counter(m.get("ID") for m in models).items() if n > 1)
    for model in models:
        yield from _of_model(model, trees)
    for tree in trees.values():
        found = [words for node in list(tree.iter())[1:] for words in _of_node(node, trees, declared)]
        found += _of_entries(tree, partial(_types, declared=declared))
        yield from (f"{words} ({tree.get('ID')})" for words in found)


def _of_file(root: Element, trees: Mapping[str, Element]) -> Iterator[str]:
    if root.get("BTCPP_format") != "4":
        yield "the format is not 4"
    if root.get("main_tree_to_execute") not in trees:
        yield "the main tree is missing"
    for identity, number in Counter(tree.get("ID", "") for tree in root.findall("BehaviorTree")).items():
        if number > 1:
            yield f"two trees are called {identity}"
        if not _is_free(identity):
            yield f"a tree cannot be called {identity!r}"
    yield from (f"the tree {name} has not exactly one root" for name, tree in trees.items() if len(tree) != 1)
    called = partial(_called_by, trees=trees)
    yield from (f"the tree {name} contains itself" for name in trees if name in reachable(called(name), called))


def _called_by(name: str, trees: Mapping[str, Element]) -> Iterator[str]:
    return (node.get("ID", "") for node in trees[name].iter("SubTree")) if name in trees else iter(())


def _of_model(model: Element, trees: Mapping[str, Element]) -> Iterator[str]:
    identity = model.get("ID", "")
    if not _is_free(identity) or model.tag not in KINDS:
        yield f"no {model.tag} can be called {identity!r}"
    if (model.tag == "SubTree") != (identity in trees):
        yield f"{identity} is declared as a {model.tag}"
    names = [each.get("name", "") for each in model if each.tag.endswith("_port")]
    yield from (f"{identity} has two ports {name}" for name, number in Counter(names).items() if number > 1)
    yield from (f"{identity} has a port {name!r}" for name in names if not _is_port(name))
    for name, port in _ports(model).items():
        default = port.get("default")
        kept = default is None or model.tag != "SubTree" or _stays(default, port.get("type"))
        if default is not None and not (_fits(default, port.get("type")) and kept):
            yield f"{identity} gives {name} the default {default!r}"


def _of_node(node: Element, trees: Mapping[str, Element], declared: Mapping[str, Element]) -> Iterator[str]:
    identity = node.get("ID", "") if node.tag == "SubTree" else node.tag
    if identity in NODES:
        children, needs = NODES[identity]
        yield from _of_children(node, identity, children)
        yield from _of_attributes(node, identity, needs.get)
        yield from (f"{identity} lacks {name}" for name in needs if name not in node.attrib)
        yield from (f"{identity} has no port {name}" for name in sorted(_passed(node) - needs.keys()))
        return
    if identity not in declared or (node.tag == "SubTree") != (declared[identity].tag == "SubTree"):
        yield f"{node.tag} {identity} is not declared"
        return
    ports = _ports(declared[identity])
    yield from _of_children(node, identity, KINDS[declared[identity].tag])
    types: dict[str, str | None] = {name: port.get("type") for name, port in ports.items()}
    if node.tag == "SubTree":
        if "name" in node.attrib:
            yield f"{identity} has a name, which is no port of a tree"
        if identity not in trees:
            yield f"{identity} is called and not in the file"
            return
        types |= dict.fromkeys(_entries(trees[identity]) - types.keys())
        needed = {name for name, port in ports.items() if not port.get("default")}
        yield from (f"{identity} leaves {name} open" for name in sorted(needed - node.attrib.keys()))
    yield from (f"{identity} has no port {name}" for name in sorted(_passed(node) - types.keys()))
    yield from _of_attributes(node, identity, types.get)
    if node.tag == "SubTree":
        constants = {name: node.attrib[name] for name in _passed(node) if not POINTER.fullmatch(node.attrib[name])}
        wrong = (name for name, value in constants.items() if value and not _stays(value, types.get(name)))
        yield from (f"{identity} is passed {node.get(name)!r} for {name}, of type {types[name]}" for name in wrong)
    outputs = (name for name, port in ports.items() if port.tag == "output_port" and name in node.attrib)
    yield from (f"{identity} puts {name} nowhere" for name in outputs if not POINTER.fullmatch(node.attrib[name]))


def _types(node: Element, declared: Mapping[str, Element]) -> Mapping[str, str | None]:
    """Return the types of a node's ports."""
    identity = node.get("ID", "") if node.tag == "SubTree" else node.tag
    if identity in NODES:
        return NODES[identity][1]
    return {name: each.get("type") for name, each in _ports(declared[identity]).items()} if identity in declared else {}


def _of_children(node: Element, identity: str, children: Children) -> Iterator[str]:
    least, most = children
    if not least <= len(node) <= most:
        yield f"{identity} has {len(node)} children"


def _of_attributes(node: Element, identity: str, type_of: Callable[[str], str | None]) -> Iterator[str]:
    for name in _passed(node):
        if not _is_port(name):
            yield f"{identity} has an attribute {name!r}"
        elif not _fits(node.attrib[name], type_of(name)):
            yield f"{identity} gives {name} the value {node.attrib[name]!r}"


def _passed(node: Element) -> set[str]:
    identity = {"ID", "name"} if node.tag == "SubTree" else set()
    return node.attrib.keys() - NAMELESS - identity


def _ports(model: Element) -> Ports:
    return {each.get("name", ""): each for each in model if each.tag.endswith("_port")}


def _entries(tree: Element) -> set[str]:
    """Return the blackboard entries that a tree uses: a call may map them although they are not declared."""
    found = (POINTER.fullmatch(value) for node in tree.iter() for value in node.attrib.values())
    return {each.group(1) for each in found if each}


def _fits(value: str, type_: str | None) -> bool:
    """Whether a value is a blackboard entry or text of the type; empty text is not a value."""
    if POINTER.fullmatch(value):
        return True
    known = type_ or "std::string"
    return bool(re.fullmatch(LITERALS[known], value)) and (known not in BOUNDS or int(value) in BOUNDS[known])


def _stays(value: str, type_: str | None) -> bool:
    """Whether a constant passed to a tree, whose type is inferred from its text, is of the port's type."""
    guessed = next((each for each in ("int", "double") if re.fullmatch(LITERALS[each], value)), None)
    return type_ is None or (type_ == guessed if guessed else type_ not in ("int", "double"))


def _of_entries(tree: Element, types_of: Callable[[Element], Mapping[str, str | None]]) -> Iterator[str]:
    """Yield the entries shared by ports of several types; an entry whose first port is untyped takes any type."""
    found: dict[str, list[str | None]] = {}
    for node in tree.iter():
        for name, type_ in types_of(node).items():
            if entry := POINTER.fullmatch(node.get(name, "")):
                found.setdefault(entry.group(1), []).append(type_)
    shared = {name: sorted({each for each in types if each}) for name, types in found.items() if types[0]}
    yield from (f"the entry {name} is {' and '.join(types)}" for name, types in shared.items() if len(types) > 1)


def _is_port(name: str) -> bool:
    return IDENTIFIER.fullmatch(name) is not None and name not in RESERVED


def _is_free(identity: str) -> bool:
    return IDENTIFIER.fullmatch(identity) is not None and identity not in BUILT_IN
