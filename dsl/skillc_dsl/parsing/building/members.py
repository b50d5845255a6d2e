"""Builds the members of skills and implementations."""

from __future__ import annotations

from typing import Literal, cast

from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.nodes import NodeBuilder
from skillc_dsl.parsing.building.places import Child, MemberPart, MemberParts, find_part, first_of_type, keyword_at
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.units import NUMBER, dimension_of, to_si

TAKEN_OVER_SINCE = 2
"""The edition with which `pre of` came; its words are older."""


class MemberBuilder(NodeBuilder):
    """Builds members; `= value` and `range a .. b` are parts of the preceding member."""

    def parameter(self, children: list[Child]) -> s.Parameter:
        """`in name: Type = default range a .. b`"""
        any_ = keyword_at(children, 1) == "any"
        at = 2 if any_ else 1
        span = self.over(children)
        return s.Parameter(
            cast(s.Direction, keyword_at(children, 0)),
            any_,
            self.label(children[at]),
            self.type_at(children, at + 1),
            self._default(children),
            first_of_type(children, s.Range),
            self.doc(span),
            span,
        )

    def refinement(self, children: list[Child]) -> s.Refinement:
        """`refine name: Type = default range a .. b`"""
        name, type_ = self.label(children[1]), self.type_at(children, 2)
        return s.Refinement(name, type_, self._default(children), first_of_type(children, s.Range), self.over(children))

    def default(self, children: list[Child]) -> MemberPart:
        """`= value`"""
        return self.part("default", children)

    def range(self, children: list[Child]) -> s.Range:
        """`range a .. b`"""
        return s.Range(self.value(children[1]), self.value(children[3]), self.over(children))

    def _default(self, children: list[Child]) -> s.Value | None:
        default = find_part(children, "default")
        return self.value(default.children[1]) if default else None

    def requirement(self, children: list[Child]) -> s.Requirement:
        """`pre|hold|post [sensed] [label:] condition [tolerance N]`"""
        kind = cast(s.RequirementKind, keyword_at(children, 0))
        sensed = keyword_at(children, 1) == "sensed"
        label = next((self.label(c) for c in children if isinstance(c, Token) and c.type == "LABEL"), None)
        found = find_part(children, "tolerance")
        condition = self.condition(children[-1] if found is None else children[-2])
        tolerance = None if found is None else self.value(found.children[1])
        if not isinstance(tolerance, s.Number | s.Quantity | None):
            raise TypeError(f"a number was expected, not {tolerance!r}")
        text = self.written(condition.span if found is None else self.over(children[-2:]))
        return s.Requirement(kind, sensed, label, condition, text, self.over(children), tolerance=tolerance)

    def possible(self, children: list[Child]) -> s.Requirement:
        """`post possible condition`"""
        condition = self.condition(children[2])
        text = self.written(condition.span)
        return s.Requirement("possible", False, None, condition, text, self.over(children))

    def tolerance(self, children: list[Child]) -> MemberPart:
        """`tolerance N`"""
        return self.part("tolerance", children)

    def some(self, children: list[Child]) -> MemberParts:
        """`post [label:] some name: Class (effect where condition)`

        It is what `infer any name: Class`, `pre condition`, `post effect` and `uses name` are.
        """
        found, span = find_part(children, "something"), self.over(children)
        taking = find_part(found.children, "taking") if found is not None else None
        if found is None or taking is None:
            raise TypeError(f"what it is on was expected, not {children!r}")
        name, type_ = self.label(found.children[1]), self.type_at(found.children, 2)
        effect, condition = self.condition(taking.children[0]), self.condition(taking.children[2])
        label = self.label(children[1]) if len(children) > 2 else None
        members = (
            s.Parameter("infer", True, name, type_, None, None, self.doc(span), span, some=True),
            s.Requirement("pre", False, None, condition, self.written(condition.span), condition.span),
            s.Requirement("post", False, label, effect, self.written(effect.span), span),
            s.DeviceUse("uses", name, name.span),
        )
        return MemberParts(members, span)

    def something(self, children: list[Child]) -> MemberPart:
        """`some name: Class (effect where condition)`"""
        return self.part("something", children)

    def taking(self, children: list[Child]) -> MemberPart:
        """`effect where condition`"""
        return self.part("taking", children)

    def taken_over(self, children: list[Child]) -> s.TakenOver:
        """`pre of Skill(argument, ..)`"""
        call, span = children[2], self.over(children)
        if not isinstance(call, s.CallSkill):
            raise TypeError(f"a call was expected, not {call!r}")
        if self.source.edition < TAKEN_OVER_SINCE:
            self.complain(span, "`pre of` came with edition 2", "write `edition = 2` in skillc.toml")
        if call.implementation is not None or call.out is not None:
            self.complain(span, "`pre of` takes a skill and arguments alone", "leave out `[..]` and `->`")
        return s.TakenOver(call, span)

    def senses(self, children: list[Child]) -> s.Senses:
        """`senses thing.property`"""
        return s.Senses(self.value(children[1]), self.over(children))

    def outcome(self, children: list[Child]) -> s.Requirement:
        """`outcome label: condition [likely N]`"""
        condition, likely = self.condition(children[2]), find_part(children, "likely")
        number = None if likely is None else self._plain_number(likely.children[1], "likely", "likely 0.9")
        text = self.written(condition.span)
        return s.Requirement("outcome", True, self.label(children[1]), condition, text, self.over(children), number)

    def likely(self, children: list[Child]) -> MemberPart:
        """`likely N`"""
        return self.part("likely", children)

    def duration(self, children: list[Child]) -> s.Duration:
        """`duration value`"""
        return s.Duration(self.value(children[1]), self.over(children))

    def cost(self, children: list[Child]) -> s.Cost:
        """`cost value`"""
        return s.Cost(self.value(children[1]), self.over(children))

    def device_use(self, children: list[Child]) -> s.DeviceUse:
        """`uses parameter`, `shares parameter`"""
        kind: Literal["uses", "shares"] = "uses" if keyword_at(children, 0) == "uses" else "shares"
        return s.DeviceUse(kind, self.as_name(children[1]), self.over(children))

    def pause(self, children: list[Child]) -> s.Pause:
        """`pause anywhere|between steps|never [keep value]`"""
        where = "between steps" if keyword_at(children, 1) == "between" else keyword_at(children, 1)
        keep = find_part(children, "keep")
        value = self.value(keep.children[1]) if keep else None
        return s.Pause(cast(s.PausePlace, where), value, self.over(children))

    def keep(self, children: list[Child]) -> MemberPart:
        """`keep value`"""
        return self.part("keep", children)

    def flag(self, children: list[Child]) -> s.Flag:
        """`scoped`, `noplan` and their like"""
        return s.Flag(keyword_at(children, 0), self.over(children))

    def let(self, children: list[Child]) -> s.Let:
        """`let name = value`"""
        return s.Let(self.as_name(children[1]), self.value(children[3]), self.over(children))

    def output(self, children: list[Child]) -> s.Output:
        """`out name = value`"""
        return s.Output(self.as_name(children[1]), self.value(children[3]), self.over(children))

    def prefer(self, children: list[Child]) -> s.Prefer:
        """`prefer N`"""
        return s.Prefer(self._plain_number(children[1], "prefer", "prefer 2"), self.over(children))

    def _plain_number(self, value: Child, word: str, example: str) -> s.Number:
        """Return the number after a word, also in per cent; another quantity is reported and its number used."""
        if isinstance(value, s.Quantity):
            is_share = dimension_of(value.unit) == NUMBER
            number = to_si(value.value, value.unit) if is_share else value.value
            if not is_share:
                self.complain(value.span, f"`{word}` takes a number without a unit", f"such as `{example}`")
            value = s.Number(number, f"{number:g}", value.span)
        if not isinstance(value, s.Number):
            raise TypeError(f"a number was expected, not {value!r}")
        return value

    def run(self, children: list[Child]) -> s.RunPython:
        """`run python "module:Class"`"""
        return s.RunPython(self.string(children[2]), self.over(children))

    def body(self, children: list[Child]) -> s.Body:
        """`do node`, `do node on failure as why { } finally { }`"""
        node = children[1]
        if not isinstance(node, s.Node):
            raise TypeError(f"a node was expected, not {node!r}")
        return s.Body(self.handled(node, children[1:]), self.over(children))

    def verify(self, children: list[Child]) -> s.Verify:
        """`verify never A [outside B]`, `verify A before B`, `verify after A eventually B`"""
        words = {child.type for child in children if isinstance(child, Token)}
        pattern = next((word for word in ("outside", "before", "eventually") if word.upper() in words), "never")
        events = [self._event(child) for child in children if not isinstance(child, Token)]
        second = events[1] if len(events) > 1 else None
        kind = cast(Literal["never", "outside", "before", "eventually"], pattern)
        return s.Verify(kind, events[0], second, self.over(children))

    def _event(self, child: Child) -> s.VerifyEvent:
        condition = self.condition(child)
        match condition:
            case s.Bare(value=s.NameReference(name=name)):
                return s.VerifyEvent(name, condition.span)
            case _:
                return s.VerifyEvent(condition, condition.span)
