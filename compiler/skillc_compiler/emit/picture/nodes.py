"""Converts the nodes of a behaviour tree to boxes."""

from __future__ import annotations

from typing import assert_never

import msgspec

from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.places import TreeBuilder

SYMBOLS = {"seq": "→", "sel": "?", "par": "⇉", "try": "~", "invert": "!", "once": "1"}


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
                return PictureBox("time", "◷", "wait", (self.places.written(time.span),))
            case s.WaitUntil(text=text):
                return PictureBox("time", "◷", "wait until", (text,))
            case s.CheckNode(text=text):
                return PictureBox("guard", "✓", "check", (text,))
            case s.ApplyPosts(labels=labels):
                return PictureBox("guard", "✎", "apply", (", ".join(label.text for label in labels),))
            case _:
                return self._around(node)

    def _around(self, node: s.Block | s.Counted | s.Timeout | s.If | s.While | s.For) -> PictureBox:
        """Return the box of a control node or decorator."""
        match node:
            case s.Block(kind=kind, children=children):
                reactive = kind.startswith("reactive")
                symbol = "↻" if reactive else SYMBOLS[kind.split()[0]]
                return PictureBox("flow", symbol, kind, (), self._all(children))
            case s.Counted(kind=kind, count=count, children=children):
                return PictureBox("flow", "↻", f"{kind} {count.text}", (), self._all(children))
            case s.Timeout(limit=limit, children=children):
                return PictureBox("time", "◷", "timeout", (self.places.written(limit.span),), self._all(children))
            case s.If(text=text):
                return PictureBox("guard", "?", "if", (text,), self._branches(node))
            case s.While(text=text, limit=limit, children=children):
                return PictureBox("guard", "↻", "while", (text, f"max {limit.text}"), self._all(children))
            case s.For(variable=variable, items=items, children=children):
                head = f"{variable.text} in {self.places.written(items.span)}"
                return PictureBox("flow", "↻", "for", (head,), self._all(children))
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
        return PictureBox("call", "▶", f"{before}{call.skill.text}{fixed}", lines, children, call.skill.text)
