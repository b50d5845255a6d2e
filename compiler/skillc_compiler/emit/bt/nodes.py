"""Translates the nodes of a body into nodes of BehaviorTree.CPP.

Nodes that it does not have are declared as custom nodes: OWNER_evaluate_ENTRY (an expression of the language),
With_SKILL (a setup that is undone when the child ends), ForEach, and Try and Invert if the child may break a hold
condition, which they must not hide. If two children of a race end in the same tick the first one decides.
"""

from __future__ import annotations

from collections.abc import Sequence as Several
from dataclasses import dataclass
from functools import partial
from typing import assert_never
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt.body import TreeWriter, join_steps, pointer, run_after, with_children
from skillc_compiler.emit.bt.calls import make_call, make_scoped, may_break_hold
from skillc_compiler.emit.bt.model import Port
from skillc_compiler.emit.bt.patterns import (
    format_rounds,
    keep_result,
    make_sequence,
    reset_script,
    run_finally,
    run_lead,
    run_once,
    run_until,
    run_while,
)
from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_dsl.descriptions.rows import SlotKind
from skillc_model.conditions import Arithmetic, Expression, Literal, Variable
from skillc_model.format_condition import format_expression
from skillc_model.skills import Post
from skillc_model.traversal import find_calls, free_variables_in_order, walk
from skillc_model.tree import (
    Apply,
    Call,
    Check,
    Decorator,
    Fail,
    Finally,
    ForEach,
    If,
    Node,
    Once,
    OnFailure,
    Parallel,
    Selector,
    Sequence,
    Wait,
    WaitUntil,
    While,
    With,
    kind_of,
    name_failure,
)
from skillc_rdf.vocabulary.types import PlainType

COUNTS = {"all": ("-1", "1"), "any": ("1", "-1"), "race": ("1", "1")}
MAX_MILLISECONDS = 2**32 - 1
"""The longest duration of Sleep and Timeout, in ms, about 49 days."""
FINALLY = "Runs its second child once the first one has ended; ends as the first one, also by a broken hold condition."
PORT_TYPES = {"count": "int", "time": "unsigned int"}


@dataclass
class NodeWriter(TreeWriter):
    """Writes the nodes of one tree."""

    def node(self, node: Node) -> Element:
        """Return the node with its descendants."""
        match node:
            case Sequence(reactive=True):
                return self._reactive(node)
            case Sequence(children=children):
                return self._control("Sequence", [self.node(each) for each in children], node)
            case Selector(children=children, reactive=reactive):
                return self._control("ReactiveFallback" if reactive else "Fallback", self._apart(children), node)
            case Parallel():
                return self._parallel(node)
            case Wait(seconds=seconds):
                before: list[Element] = []
                return run_after(before, Element("Sleep", msec=self._milliseconds(seconds, 0, before)))
            case Fail(reason=reason, source=source):
                text = format_expression(reason, self.library.vocabulary)
                return Element("AlwaysFailure", _description=f"{source}: {text}")
            case OnFailure():
                return self._on_failure(node)
            case Finally():
                return self._finally(node)
            case Once(child=child):
                return self._once(child)
            case WaitUntil() | If() | While() | ForEach() | Check() | Apply() | Call() | With():
                return self._deciding(node)
            case _:
                return self._decorator(node)

    def _deciding(self, node: WaitUntil | If | While | ForEach | Check | Apply | Call | With) -> Element:
        match node:
            case WaitUntil(condition=condition, text=text, source=source):
                return run_until(self.test("until", condition, text, source))
            case If(condition=condition, text=text, source=source):
                test = self.test("if", condition, text, source)
                branches = self._apart([each for each in (node.then, node.orelse) if each])
                otherwise = [] if node.orelse else [Element("AlwaysSuccess")]
                return with_children(Element("IfThenElse"), test, *branches, *otherwise)
            case While(child=child, limit=limit, source=source):
                before: list[Element] = []
                most = limit if isinstance(limit, int) else self.value("most", limit, before, "int")
                test = self.test("while", node.condition, node.text, source)
                loop = run_while(test, self.node(child), most, self.entry("done"), self.entry("rounds"))
                return run_after(before, loop)
            case ForEach():
                return self._for_each(node)
            case Check(condition=condition, text=text, source=source):
                return self.test("check", condition, text, source)
            case Apply(labels=labels):
                return join_steps([self._apply(post) for label in labels for post in self.posts if post.label == label])
            case Call():
                return make_call(self, node)
            case With(call=set_up, child=child):
                return make_scoped(self, set_up, partial(self.node, child))
            case _:
                assert_never(node)

    def _control(self, tag: str, children: Several[Element], node: Sequence | Selector) -> Element:
        return with_children(Element(tag, _description=str(node.source)), *children)

    def _apart(self, nodes: Several[Node]) -> list[Element]:
        return self.apart([partial(self.node, each) for each in nodes])

    def _parallel(self, node: Parallel) -> Element:
        children = self._apart(node.children)
        if node.policy == "lead":
            parallel = run_lead(children[0], children[1:])
        else:
            success, failure = COUNTS[node.policy]
            parallel = with_children(Element("Parallel", success_count=success, failure_count=failure), *children)
        parallel.set("_description", str(node.source))
        return parallel

    def _reactive(self, node: Sequence) -> Element:
        """Return the sequence; a child that succeeded and is not a test does not run again while its results hold."""
        entries: list[str] = []
        reactive = Element("ReactiveSequence", _description=str(node.source))
        for child in node.children:
            if isinstance(child, Check | WaitUntil):
                reactive.append(self.node(child))
                continue
            entries.append(self.entry("done"))
            reactive.append(keep_result(self.node(child), self._still(child), entries[-1]))
        return make_sequence(Element("Script", code=reset_script(entries)), reactive) if entries else reactive

    def _still(self, child: Node) -> list[Element]:
        """Return the test that the child's postconditions and tested conditions still hold; empty if it has none."""
        calls = list(find_calls(child))
        tested = [each for each in walk(child) if isinstance(each, Check | WaitUntil | If | While)]
        relied = [f"{each.skill}: {post.text}" for each in calls for post in self.library.skills[each.skill].post]
        relied += [each.text for each in tested]
        if not relied:
            return []
        arguments = [value for each in calls for value in each.arguments.values()]
        read = (*arguments, *(each.condition for each in tested))
        variables = list(dict.fromkeys(name for each in read for name in free_variables_in_order(each)))
        path = (*self.owner, f"still{self.number('still')}")
        return [self.reading("Condition", path, variables, f"Still: {'; '.join(relied)}", child.source)]

    def _on_failure(self, node: OnFailure) -> Element:
        """Return a fallback; a tree of BehaviorTree.CPP does not tell why a node failed, so the parts are that text."""
        around = self.bound
        block = self.node(node.child)
        after, self.bound = self.bound, around
        read = {each.name for each in walk(node.handler) if isinstance(each, Variable)}
        parts = [name for name in (name_failure(node.why) if node.why is not None else ()) if name in read]
        script = "; ".join(f"{self.bind(name, PlainType('Text')).entry} := '{name}'" for name in parts)
        handler = self.node(node.handler)
        self.bound = {**self.bound, **after}
        told = run_after([Element("Script", code=script)] if parts else [], handler)
        return with_children(Element("Fallback", _description=str(node.source)), block, told)

    def _finally(self, node: Finally) -> Element:
        """Return the block, then what is done at the end; declared as a node where the block may break a hold."""
        block, last = self.node(node.child), self.node(node.last)
        if may_break_hold(self.library, node.child):
            identity = self.names.of("", "Finally")
            self.model.declare("Control", identity, ("", "Finally"), (), FINALLY)
            return with_children(Element(identity, _description=str(node.source)), block, last)
        return run_finally(block, last, self.entry("worked"), str(node.source))

    def _once(self, child: Node) -> Element:
        entry = self.entry("once")
        self.start.append(reset_script([entry]))
        return run_once(self.node(child), entry)

    def _decorator(self, node: Decorator) -> Element:
        """Return the node of BehaviorTree.CPP, or one that is declared if that would hide a broken hold condition."""
        row = DECORATOR_OF[kind_of(node)]
        tag = row.tree_cpp
        if not tag or (row.on_failure == "success" and may_break_hold(self.library, node.child)):
            path = ("", row.kind.capitalize())
            tag = self.names.of(*path)
            ports = [Port(slot.port, type=PORT_TYPES[slot.kind]) for slot in row.slots]
            self.model.declare("Decorator", tag, path, ports, row.tree_cpp_doc)
        child, before = self.node(node.child), list[Element]()
        attributes = {slot.port: self._slot(getattr(node, slot.field), slot.kind, before) for slot in row.slots}
        return run_after(before, with_children(Element(tag, attributes), child))

    def _slot(self, value: int | Expression, kind: SlotKind, before: list[Element]) -> str:
        if isinstance(value, int):
            return format_rounds(value)
        return self.value("rounds", value, before, "int") if kind == "count" else self._milliseconds(value, 1, before)

    def _milliseconds(self, seconds: Expression, least: int, before: list[Element]) -> str:
        """Return a time in milliseconds, at least `least`: a timeout of 0 would never expire."""
        if isinstance(seconds, Literal) and isinstance(seconds.value, int | float):
            return str(min(max(least, round(seconds.value * 1000)), MAX_MILLISECONDS))
        return self.value("milliseconds", Arithmetic("*", seconds, Literal(1000.0)), before, "unsigned int")

    def _for_each(self, node: ForEach) -> Element:
        before: list[Element] = []
        items = self.value("items", node.items, before)
        identity = self.names.of("", "ForEach")
        ports = (Port("items"), Port("item", "output"))
        self.model.declare(
            "Decorator", identity, ("", "ForEach"), ports, "Runs its child once for every item, in order."
        )
        around, item = self.bound, self.bind(node.variable, None)
        attributes = {"items": items, "item": pointer(item.entry), "_description": str(node.source)}
        child = self.node(node.child)
        self.bound = {name: each for name, each in self.bound.items() if name != node.variable or name in around}
        return run_after(before, with_children(Element(identity, attributes), child))

    def _apply(self, post: Post) -> Element:
        path = (*self.owner, "apply", post.label)
        return self.reading(
            "Action", path, free_variables_in_order(post.condition), f"Writes: {post.text}", post.source
        )


def with_start_scripts(body: NodeWriter, steps: list[Element]) -> Element:
    """Return a sequence of the start scripts of the body and the steps."""
    scripts = [Element("Script", code="; ".join(body.start))] if body.start else []
    return join_steps([*scripts, *steps])
