"""The nodes of an implementation's body as nodes of BehaviorTree.CPP.

What has no counterpart there is declared under a name of its own: ParallelLead (the first child decides), WaitUntil,
ForEach, OWNER_evaluate_ENTRY (an expression of the language) and With_SKILL (what is undone when the child ends).
"""

from __future__ import annotations

from collections.abc import Sequence as Several
from dataclasses import dataclass, field
from typing import assert_never
from xml.etree.ElementTree import Element

from skillc_compiler.emit.bt_model import Kind, Model, Port
from skillc_compiler.emit.bt_names import Names, port
from skillc_compiler.emit.bt_ports import action_ports, defaults, passed_on, plain_value, tree_ports
from skillc_compiler.emit.phrases import expression_text
from skillc_compiler.library.conditions import Arithmetic, Condition, Expression, Literal
from skillc_compiler.library.reading import free_variables_in_order
from skillc_compiler.library.skills import Compound, Implementation, Post, Skill, SkillLibrary
from skillc_compiler.library.tree import (
    Apply,
    Call,
    Check,
    ForEach,
    If,
    Invert,
    Node,
    Once,
    Parallel,
    Repeat,
    Retry,
    Selector,
    Sequence,
    Timeout,
    Try,
    Wait,
    WaitUntil,
    While,
    With,
)
from skillc_compiler.library.vocabulary import Position

COUNTS = {"all": ("-1", "1"), "any": ("1", "-1"), "race": ("1", "1")}


@dataclass
class Body:
    """Makes the nodes of one tree; `owner` is the path of names of whom the tree belongs to."""

    library: SkillLibrary
    names: Names
    model: Model
    owner: tuple[str, ...]
    posts: Several[Post] = ()
    _made: dict[str, int] = field(default_factory=dict)

    def node(self, node: Node) -> Element:
        """Return the node with everything below it."""
        match node:
            case Sequence(children=children, reactive=reactive):
                return self._control("ReactiveSequence" if reactive else "Sequence", children, node.source)
            case Selector(children=children, reactive=reactive):
                return self._control("ReactiveFallback" if reactive else "Fallback", children, node.source)
            case Parallel():
                return self._parallel(node)
            case Retry(count=count, child=child):
                return self._around(Element("RetryUntilSuccessful", num_attempts=str(count)), child)
            case Repeat(count=count, child=child):
                return self._around(Element("Repeat", num_cycles=str(count)), child)
            case Timeout(seconds=seconds, child=child):
                return self._timed("Timeout", seconds, child)
            case Wait(seconds=seconds):
                return self._timed("Sleep", seconds, None)
            case Try(child=child):
                return self._around(Element("ForceSuccess"), child)
            case Invert(child=child):
                return self._around(Element("Inverter"), child)
            case Once(child=child):
                return self._around(Element("RunOnce", then_skip="false"), child)
            case _:
                return self._deciding(node)

    def _deciding(self, node: WaitUntil | If | While | ForEach | Check | Apply | Call | With) -> Element:
        match node:
            case WaitUntil(condition=condition, text=text, source=source):
                self.model.declare("Decorator", "WaitUntil", (), "Runs until its child succeeds.")
                return _holding(Element("Decorator", ID="WaitUntil"), self.test("until", condition, text, source))
            case If(condition=condition, text=text, source=source):
                orelse = self.node(node.orelse) if node.orelse else Element("AlwaysSuccess")
                test = self.test("if", condition, text, source)
                return _holding(Element("IfThenElse"), test, self.node(node.then), orelse)
            case While():
                return self._while(node)
            case ForEach():
                return self._for_each(node)
            case Check(condition=condition, text=text, source=source):
                return self.test("check", condition, text, source)
            case Apply(labels=labels):
                applied = [self._apply(post) for label in labels for post in self.posts if post.label == label]
                return applied[0] if len(applied) == 1 else _holding(Element("Sequence"), *applied)
            case Call():
                return self.call(node)
            case With(call=call, child=child):
                return self._with(call, child)
            case _:
                assert_never(node)

    def condition(self, path: tuple[str, ...], condition: Condition, text: str, source: Position) -> Element:
        """Return the test of a condition, declared as a node of its own."""
        identity = self.names.of(*path)
        variables = free_variables_in_order(condition)
        self.model.declare("Condition", identity, [Port(port(name)) for name in variables], text)
        return _node("Condition", identity, {port(name): f"{{{port(name)}}}" for name in variables}, source)

    def test(self, word: str, condition: Condition, text: str, source: Position) -> Element:
        """Return the test of a condition that has no label of its own."""
        return self.condition((*self.owner, f"{word}{self._number(word)}"), condition, text, source)

    def evaluate(self, expression: Expression, entry: str) -> Element:
        """Return the node that puts the value of an expression into an entry of the blackboard."""
        identity = self.names.of(*self.owner, "evaluate", entry)
        read = [port(name) for name in free_variables_in_order(expression)]
        result = "value_" if "value" in read else "value"
        ports = [*(Port(name) for name in read), Port(result, "output")]
        text = expression_text(expression, self.library.vocabulary)
        self.model.declare("Action", identity, ports, f"Computes: {text}")
        return Element("Action", {"ID": identity, **{name: f"{{{name}}}" for name in read}, result: f"{{{entry}}}"})

    def call(self, call: Call) -> Element:
        """Return the call of a skill, after the expressions among its arguments."""
        skill = self.library.skills[call.skill]
        before, attributes = self._arguments(call)
        if call.out is not None:
            outputs = [each.name for each in skill.parameters if each.direction == "out"]
            attributes |= {port(name): f"{{{port(call.out)}}}" for name in outputs[:1]}
        if not is_tree(self.library, skill):
            ports = action_ports(skill.parameters)
            return _after(before, self._run("Action", (skill.name,), ports, skill.doc, attributes, call.source))
        path: tuple[str, ...] = (skill.name,)
        described = skill.parameters
        if call.implementation is not None:
            path = (skill.name, "only", call.implementation)
            described = self.library.implementations[f"{skill.name}.{call.implementation}"].parameters
        attributes = {**defaults(described), **attributes}
        ports = tree_ports(described)
        return _after(before, self._run("SubTree", path, ports, skill.doc, attributes, call.source))

    def run(self, implementation: Implementation) -> Element:
        """Return the node that runs an implementation of the skill whose tree this is, on the entries of that tree."""
        kind: Kind = "SubTree" if isinstance(implementation.body, Compound) else "Action"
        path, ports = (implementation.skill, implementation.name), action_ports(implementation.parameters)
        attributes = passed_on(implementation.parameters)
        return self._run(kind, path, ports, implementation.doc, attributes, implementation.source)

    def _run(
        self,
        kind: Kind,
        path: tuple[str, ...],
        ports: Several[Port],
        doc: str,
        attributes: dict[str, str],
        source: Position,
    ) -> Element:
        identity = self.names.of(*path)
        self.model.declare(kind, identity, ports, doc)
        return _node(kind, identity, attributes, source)

    def _arguments(self, call: Call) -> tuple[list[Element], dict[str, str]]:
        before: list[Element] = []
        attributes: dict[str, str] = {}
        for name, expression in call.arguments.items():
            attributes[port(name)] = self._value(name, expression, before)
        return before, attributes

    def _value(self, name: str, expression: Expression, before: list[Element]) -> str:
        plain = plain_value(expression)
        if plain is not None:
            return plain
        entry = f"{port(name)}__{self._number('value')}"
        before.append(self.evaluate(expression, entry))
        return f"{{{entry}}}"

    def _control(self, tag: str, children: Several[Node], source: Position) -> Element:
        return _holding(Element(tag, _description=str(source)), *(self.node(child) for child in children))

    def _around(self, decorator: Element, child: Node) -> Element:
        return _holding(decorator, self.node(child))

    def _parallel(self, node: Parallel) -> Element:
        if node.policy == "lead":
            self.model.declare(
                "Control", "ParallelLead", (), "Runs all children; the first decides, then the rest stop."
            )
            parallel = Element("Control", ID="ParallelLead")
        else:
            success, failure = COUNTS[node.policy]
            parallel = Element("Parallel", success_count=success, failure_count=failure)
        parallel.set("_description", str(node.source))
        return _holding(parallel, *(self.node(child) for child in node.children))

    def _timed(self, tag: str, seconds: Expression, child: Node | None) -> Element:
        before = []
        if isinstance(seconds, Literal) and isinstance(seconds.value, int | float):
            milliseconds = str(round(seconds.value * 1000))
        else:
            entry = f"milliseconds__{self._number('value')}"
            before.append(self.evaluate(Arithmetic("*", seconds, Literal(1000.0)), entry))
            milliseconds = f"{{{entry}}}"
        timed = Element(tag, msec=milliseconds)
        return _after(before, timed if child is None else self._around(timed, child))

    def _while(self, node: While) -> Element:
        """Up to `limit` rounds that do nothing once the condition fails; it must have failed in the end."""
        number = self._number("while")
        tests = []
        for _ in range(2):
            path = (*self.owner, f"while{number}")
            tests.append(_holding(Element("Inverter"), self.condition(path, node.condition, node.text, node.source)))
        round_ = _holding(Element("Fallback"), tests[0], self.node(node.child))
        rounds = _holding(Element("Repeat", num_cycles=str(node.limit)), round_)
        return _holding(Element("Sequence", _description=str(node.source)), rounds, tests[1])

    def _for_each(self, node: ForEach) -> Element:
        before: list[Element] = []
        items = self._value("items", node.items, before)
        ports = (Port("items"), Port("item", "output"))
        self.model.declare("Decorator", "ForEach", ports, "Runs its child once for every item, in order.")
        item = f"{{{port(node.variable)}}}"
        loop = Element("Decorator", ID="ForEach", items=items, item=item, _description=str(node.source))
        return _after(before, self._around(loop, node.child))

    def _apply(self, post: Post) -> Element:
        identity = self.names.of(self.owner[0], "apply", post.label)
        variables = free_variables_in_order(post.condition)
        self.model.declare("Action", identity, [Port(port(name)) for name in variables], f"Writes: {post.text}")
        return _node("Action", identity, {port(name): f"{{{port(name)}}}" for name in variables}, post.source)

    def _with(self, call: Call, child: Node) -> Element:
        skill = self.library.skills[call.skill]
        identity = self.names.of("With", skill.name)
        self.model.declare("Decorator", identity, action_ports(skill.parameters), skill.doc)
        before, attributes = self._arguments(call)
        return _after(before, self._around(_node("Decorator", identity, attributes, call.source), child))

    def _number(self, word: str) -> int:
        self._made[word] = self._made.get(word, 0) + 1
        return self._made[word]


def is_tree(library: SkillLibrary, skill: Skill) -> bool:
    """Whether a skill is a tree; else it is a single action."""
    bodies = [each.body for each in library.implementations_of(skill.name)]
    return len(bodies) > 1 or any(isinstance(body, Compound) for body in bodies)


def _node(kind: str, identity: str, attributes: dict[str, str], source: Position) -> Element:
    return Element(kind, {"ID": identity, **attributes, "_description": str(source)})


def _holding(parent: Element, *children: Element) -> Element:
    parent.extend(children)
    return parent


def _after(before: Several[Element], node: Element) -> Element:
    return _holding(Element("Sequence"), *before, node) if before else node
