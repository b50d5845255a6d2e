"""Converts the nodes of a behaviour tree to boxes."""

from __future__ import annotations

from typing import assert_never

import msgspec

from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_dsl import syntax as s
from skillc_dsl.descriptions.nodes import PICTURES
from skillc_dsl.parsing.building.places import TreeBuilder


class NodeDrawer(msgspec.Struct, frozen=True):
    """Converts the nodes of one file; `places` has its text."""

    places: TreeBuilder

    def box(self, node: s.Node) -> PictureBox:
        """Return the box of a node with the boxes of its children."""
        match node:
            case s.CallSkill():
                return self._call(node, "", ())
            case s.With(call=call, children=children):
                return self._call(call, "with ", self._all(children))
            case s.Wait(time=time):
                return _box("wait", self.places.written(time.span))
            case s.WaitUntil(text=text):
                return _box("wait until", text)
            case s.CheckNode(text=text):
                return _box("check", text)
            case s.Fail(message=message):
                return _box("fail", message.text)
            case s.ApplyPosts(labels=labels):
                return _box("apply", ", ".join(label.text for label in labels))
            case _:
                return self._around(node)

    def _around(self, node: s.Block | s.Decorator | s.If | s.OnFailure | s.Finally | s.While | s.For) -> PictureBox:
        """Return the box of a control node or decorator."""
        match node:
            case s.Block(kind=kind, children=children):
                return _box(kind if kind in PICTURES else "par", title=kind, children=self._all(children))
            case s.Decorator(kind=kind, row=row, children=children):
                slots = [
                    (self.places.written(value.span), slot.kind)
                    for value, slot in zip(node.slots, row.slots, strict=True)
                ]
                title = " ".join((kind, *(text for text, what in slots if what == "count")))
                times = tuple(text for text, what in slots if what == "time")
                return PictureBox(row.picture.kind, row.picture.symbol, title, times, self._all(children))
            case s.If(text=text):
                return _box("if", text, children=self._branches(node))
            case s.OnFailure(node=block, why=why, handler=handler):
                title = f"on failure as {why.text}" if why else "on failure"
                then = PictureBox("flow", "−", title, (), self._all(handler))
                return _box("on failure", children=(self.box(block), then))
            case s.Finally(node=block, last=last):
                return _box(
                    "finally", children=(self.box(block), PictureBox("flow", "→", "finally", (), self._all(last)))
                )
            case s.While(text=text, limit=limit, children=children):
                return _box("while", text, f"max {self.places.written(limit.span)}", children=self._all(children))
            case s.For(variable=variable, items=items, children=children):
                between = ":" if isinstance(items, s.Every) else " in"
                head = f"{variable.text}{between} {self.places.written(items.span)}"
                return _box("for", head, children=self._all(children))
            case _:
                assert_never(node)

    def _branches(self, node: s.If) -> tuple[PictureBox, ...]:
        if node.orelse is None:
            return self._all(node.then)
        return (
            PictureBox("flow", "+", "then", (), self._all(node.then)),
            PictureBox("flow", "−", "else", (), self._all(node.orelse)),
        )

    def _all(self, nodes: tuple[s.Node, ...]) -> tuple[PictureBox, ...]:
        return tuple(self.box(node) for node in nodes)

    def _call(self, call: s.CallSkill, before: str, children: tuple[PictureBox, ...]) -> PictureBox:
        fixed = f"[{call.implementation.text}]" if call.implementation else ""
        arguments = ", ".join(self.places.written(argument.span) for argument in call.arguments)
        out = f"-> {call.out.text}" if call.out else ""
        lines = tuple(line for line in (arguments, out) if line)
        return _box(
            "call", *lines, title=f"{before}{call.skill.text}{fixed}", children=children, called=call.skill.text
        )


def _box(
    kind: str, *lines: str, title: str = "", children: tuple[PictureBox, ...] = (), called: str | None = None
) -> PictureBox:
    """Return the box of a kind of node, which is its title if there is no other."""
    picture = PICTURES[kind]
    return PictureBox(picture.kind, picture.symbol, title or kind, lines, children, called)
