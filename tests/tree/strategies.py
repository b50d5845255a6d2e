"""Random trees of scripted skills, with the library they need and the scripts they follow."""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st

from skillc_model import tree
from skillc_model.conditions import Compare, Condition, Individual, Literal, PropertyOf
from skillc_model.skills import SkillLibrary
from tree.library import DEVICES, ON, SCRIPTED, Library, call, here, par, sel, seq, with_
from tree.library import FLAGS as ALL_FLAGS
from tree.stage import PERIOD_S, Script

FLAGS = ALL_FLAGS[:2]
"""Few, so that switches often matter."""

ENDINGS = ("success", "success", "success", "fail", "fail", "crash", "refuse", "crash at start")

CONTESTED_ENDINGS = ("success", "success", "success", "fail", "refuse")

KINDS = ("leaf", "several", "several", "several", "loop", "decorator", "around", "branch", "handled")

SKILLS = ("Act", "Act", "Setup", "Kept", "Kept", "Lit", "Set", "Use", "Either", "Another", "", "")

CROWDED_KINDS = ("leaf", "several", "decorator", "handled", "crowd", "using", "using")

CROWDED_SKILLS = ("Use", "Use", "Use", "Act", "Kept", "")

CONTESTED_SKILLS = ("Use", "Use", "Use", "Use", "Act", "Kept", "Lit", "Set", "Another", "")


@dataclass(frozen=True)
class Play:
    """A tree with everything that decides what happens: scripts by name, flag changes by tick, when to halt."""

    body: tree.Node
    library: SkillLibrary = field(repr=False)
    scripts: dict[str, list[Script]]
    switches: tuple[tuple[int, str, bool], ...]
    halt_at: int | None


@st.composite
def plays(
    draw: st.DrawFn, size: int = 12, python: str = SCRIPTED, contested: bool = False, crowded: bool = False
) -> Play:
    """Draw a tree of about so many leaves; `python` is the class of every primitive.

    In a `contested` one, branches of reactive nodes need the same devices, under conditions that flip often. In a
    `crowded` one, what runs in parallel needs the same devices, within what uses others.
    """
    writer = _Writer(draw, size, python, contested)
    if crowded:
        writer.skills, writer.kinds, writer.longest = CROWDED_SKILLS, CROWDED_KINDS, 4
    body = writer.crowd(4) if crowded else writer.contest(3) if contested else writer.node(4)
    switch = st.tuples(st.integers(1, 12 if contested else 6), st.sampled_from(FLAGS), st.booleans())
    switches = draw(st.lists(switch, min_size=4 if contested else 0, max_size=16 if contested else 8))
    halt_at = draw(st.one_of(st.none(), st.none(), st.integers(1, 12)))
    return Play(body, writer.library.build(), writer.scripts, tuple(switches), halt_at)


class _Writer:
    def __init__(self, draw: st.DrawFn, size: int, python: str, contested: bool) -> None:
        self.draw = draw
        self.skills, self.kinds = (CONTESTED_SKILLS, (*KINDS, "contest")) if contested else (SKILLS, KINDS)
        self.endings, self.longest = (CONTESTED_ENDINGS, 9) if contested else (ENDINGS, 4)
        self.left = size
        self.library = Library(python)
        self.scripts: dict[str, list[Script]] = {}

    def node(self, depth: int) -> tree.Node:
        if depth <= 0 or self.left <= 0:
            return self.leaf()
        kind = self.draw(st.sampled_from(self.kinds))
        make = {
            "several": self.several,
            "loop": self.loop,
            "decorator": self.decorator,
            "around": self.around,
            "branch": self.branch,
            "handled": self.handled,
            "contest": self.contest,
            "crowd": self.crowd,
            "using": self.using,
        }
        return self.leaf() if kind == "leaf" else make[kind](depth - 1)

    def leaf(self) -> tree.Node:
        self.left -= 1
        skill = self.draw(st.sampled_from(self.skills))
        if not skill:
            return self.condition_leaf()
        more: dict[str, str | bool] = {}
        if skill in ("Kept", "Lit", "Set"):
            more["flag"] = self.draw(st.sampled_from(FLAGS))
        if skill == "Set":
            more["value"] = self.draw(st.booleans())
        if skill == "Use":
            more["device"] = self.draw(st.sampled_from(DEVICES))
        return call(skill, name=self.name(), **more)

    def condition_leaf(self) -> tree.Node:
        kind = self.draw(st.sampled_from(("check", "check", "until", "wait", "fail")))
        if kind == "fail":
            return tree.Fail(reason=Literal("no"), source=here())
        if kind == "wait":
            return tree.Wait(seconds=Literal(self.draw(st.integers(0, 3)) * PERIOD_S), source=here())
        condition = self.condition()
        if kind == "check":
            return tree.Check(condition=condition, text="on", source=here())
        return tree.WaitUntil(condition=condition, text="on", source=here())

    def several(self, depth: int) -> tree.Node:
        children = tuple(self.node(depth) for _ in range(self.draw(st.integers(1, 4))))
        kind = self.draw(st.sampled_from(("seq", "sel", "par", "par")))
        if kind == "par":
            return par(self.draw(st.sampled_from(("all", "any", "race", "lead"))), *children)
        reactive = self.draw(st.booleans())
        return seq(*children, reactive=reactive) if kind == "seq" else sel(*children, reactive=reactive)

    def contest(self, depth: int) -> tree.Node:
        """Draw a reactive node whose branches begin with a condition."""
        branches = [self.guarded(depth) for _ in range(self.draw(st.integers(1, 2)))]
        make = self.draw(st.sampled_from((sel, sel, seq)))
        return make(*branches, self.node(depth - 1), reactive=True)

    def crowd(self, depth: int) -> tree.Node:
        """Draw a parallel node whose children use devices, most of them after others that they still use."""
        policy = self.draw(st.sampled_from(("all", "all", "any", "race", "lead")))
        return par(policy, *(self.using(depth - 1) for _ in range(self.draw(st.integers(2, 4)))))

    def using(self, depth: int) -> tree.Node:
        """Draw a call that uses a device, and then calls others."""
        body = seq(*(self.node(depth - 1) for _ in range(self.draw(st.integers(1, 2)))))
        return call(self.library.using(body), device=self.draw(st.sampled_from(DEVICES)))

    def guarded(self, depth: int) -> tree.Node:
        test = tree.Check(condition=self.condition(), text="on", source=here())
        rest = self.node(depth - 1)
        match self.draw(st.sampled_from(("seq", "seq", "if", "alone"))):
            case "seq":
                return seq(test, rest)
            case "if":
                return tree.If(condition=self.condition(), text="on", then=rest, orelse=test, source=here())
            case _:
                return rest

    def loop(self, depth: int) -> tree.Node:
        child, limit = self.node(depth), self.draw(st.integers(1, 3))
        count = Literal(limit) if self.draw(st.booleans()) else limit
        kind = self.draw(st.sampled_from(("retry", "repeat", "while")))
        if kind == "retry":
            return tree.Retry(count=count, child=child, source=here())
        if kind == "repeat":
            return tree.Repeat(count=count, child=child, source=here())
        return tree.While(condition=self.condition(), text="on", limit=limit, child=child, source=here())

    def decorator(self, depth: int) -> tree.Node:
        child = self.node(depth)
        kind = self.draw(st.sampled_from((tree.Try, tree.Try, tree.Invert, tree.Once, tree.Timeout)))
        if kind is tree.Timeout:
            return tree.Timeout(seconds=Literal(self.draw(st.integers(0, 4)) * PERIOD_S), child=child, source=here())
        return kind(child=child, source=here())

    def handled(self, depth: int) -> tree.Node:
        child, more = self.node(depth), self.node(depth)
        if self.draw(st.booleans()):
            return tree.Finally(child=child, last=more, source=here())
        return tree.OnFailure(child=child, why="why", handler=more, source=here())

    def around(self, depth: int) -> tree.Node:
        child = self.node(depth)
        kind = self.draw(st.sampled_from(("with", "with", "guarded", "using")))
        if kind == "guarded":
            return call(self.library.guarded(child), flag=self.draw(st.sampled_from(FLAGS)))
        if kind == "using":
            return call(self.library.using(child), device=self.draw(st.sampled_from(DEVICES)))
        return with_(self.name(), child)

    def branch(self, depth: int) -> tree.Node:
        orelse = self.node(depth) if self.draw(st.booleans()) else None
        return tree.If(condition=self.condition(), text="on", then=self.node(depth), orelse=orelse, source=here())

    def condition(self) -> Condition:
        flag = Individual(self.draw(st.sampled_from(FLAGS)))
        return Compare(PropertyOf(flag, ON), "==", Literal(self.draw(st.booleans())))

    def name(self) -> str:
        name = f"a{len(self.scripts)}"
        script = st.builds(Script, st.sampled_from(self.endings), st.integers(1, self.longest))
        self.scripts[name] = self.draw(st.lists(script, min_size=1, max_size=3))
        return name
