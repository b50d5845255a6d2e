"""Random libraries: primitives with random contracts, compounds with random bodies, as text."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

TERMS = """
class Item
class Heavy < Item
class Spot disjoint Item
relation touches(Item, Spot)
relation at(Item, Spot)  functional sub touches
relation near(Item, Item)  symmetric
relation follows(Item, Item)  transitive
relation holds(Spot, Item)  inverse at
property on(Item): Bool
property level(Item): Number
function items() -> [Item] = python "analysis.actors:items"
"""
PLAIN = "    in a: Item\n    in b: Item\n    in s: Spot\n    in t: Spot\n"
PRIMITIVES, COMPOUNDS = 5, 3


@dataclass
class Writer:
    """Writes one library; `compounds` are the names of the skills that have bodies."""

    random: Random

    def library(self) -> str:
        """Return the text."""
        text = TERMS + "".join(self.primitive(f"P{n}") for n in range(PRIMITIVES))
        text += "skill Sense {\n" + PLAIN + "    post sensed seen: a.on == true\n    noplan\n}\n"
        text += 'impl one of Sense { run python "analysis.actors:Sensor" }\n'
        text += "skill Find {\n    in a: Item\n    infer any s: Spot\n    pre a touches s\n"
        text += f"    post {self.literal('a', 'a', 's', 's')}\n    noplan\n}}\n"
        text += 'impl one of Find { run python "analysis.actors:Actor" }\n'
        text += "skill Any {\n    infer any a: Item\n    in s: Spot\n    pre a.on == true\n    pre not a at s\n"
        text += f"    post {self.literal('a', 'a', 's', 's')}\n    noplan\n}}\n"
        text += 'impl one of Any { run python "analysis.actors:Actor" }\n'
        text += self.primitive("Setup", "    scoped\n")
        return text + "".join(self.compound(n) for n in range(COMPOUNDS))

    def primitive(self, name: str, more: str = "") -> str:
        """Write a skill with two implementations that chance plays."""
        posts = {self.literal() for _ in range(self.random.randint(0, 2))}
        head = f"skill {name} {{\n{PLAIN}{self.needs()}{more}" + "".join(f"    post {post}\n" for post in sorted(posts))
        fallback = "    fallback\n" if self.random.random() < 0.2 else ""
        impls = "".join(
            f'impl way{n} of {name} {{ prefer {n} run python "analysis.actors:Actor" }}\n'
            for n in range(self.random.randint(1, 2))
        )
        return f"{head}{fallback}    noplan\n}}\n{impls}"

    def compound(self, number: int) -> str:
        """Write a skill with a body of calls of primitives and of compounds before it."""
        labels = [f"p{n}" for n in range(self.random.randint(0, 2))]
        posts = "".join(f"    post {label}: {self.literal()}\n" for label in labels)
        callable_ = [f"P{n}" for n in range(PRIMITIVES)] + ["Sense", "Setup"] + [f"C{n}" for n in range(number)] * 2
        body = Body(self, callable_, labels).node(4)
        lines = "".join(f"    verify {self.property(callable_)}\n" for _ in range(2))
        count = f"    opt n: Int = {self.random.randint(1, 3)}  range 1 .. 3\n"
        head = f"skill C{number} {{\n{PLAIN}{count}{self.needs()}{posts}    noplan\n}}\n"
        return f"{head}impl body of C{number} {{\n    do {body}\n{lines}}}\n"

    def needs(self) -> str:
        """Write preconditions and holds."""
        pre = "".join(f"    pre {self.condition()}\n" for _ in range(self.random.choice((0, 1, 1, 2))))
        return pre + "".join(f"    hold {self.condition()}\n" for _ in range(self.random.choice((0, 0, 0, 1))))

    def property(self, skills: list[str]) -> str:
        """Write what a `verify` line says."""
        one, other = self.random.choice(skills), self.random.choice(skills)
        forms = (f"never {one}", f"never {one} outside {other}", f"{one} before {other}")
        return self.random.choice((*forms, f"after {one} eventually {other}", f"never {self.condition()}"))

    def literal(self, a: str = "a", b: str = "b", s: str = "s", t: str = "t") -> str:
        """Write something that can be made true."""
        spot, one, other = self.random.choice((s, t)), *self.random.choice(((a, b), (b, a)))
        forms = (
            f"{one} at {spot}", f"not {one} at {spot}", f"{one} touches {spot}", f"not {one} touches {spot}",
            f"{one} near {other}", f"not {one} near {other}", f"{one} follows {other}", f"{spot} holds {one}",
            f"not {one} at _", f"{one}.on == true", f"{one}.on == false", f"{one}.level == {self.random.randint(1, 4)}",
        )  # fmt: skip
        return self.random.choice(forms)

    def condition(self, a: str = "a", b: str = "b") -> str:
        """Write a condition."""
        one = self.literal(a, b)
        more = (
            f"{a} == {b}", f"not {a} == {b}", f"{a} is Heavy", f"{b} has level", f"{a}.level > 2", f"{b} at _",
            "_ at s", "exists x: Item (x at s)", f"not {one}" if not one.startswith("not") else one,
            f"({one} or {b}.on == true)", f"({one} and {a}.level <= 3)",
        )  # fmt: skip
        return self.random.choice((one, one, one, *more, self.quantified(a), self.quantified(b)))

    def quantified(self, a: str) -> str:
        """Write a condition on all individuals of a class, or some one."""
        return self.random.choice((
            "exists x: Heavy (x at s)", "not exists x: Item (s holds x)", "forall x: Item (not x at t)",
            f"exists x: Item ({a} near x)", f"exists x: Spot ({a} at x)", f"forall x: Spot (not {a} touches x)",
            "exists x: Item (x at s and x.on == true)", "forall x: Item (x at s implies x.on == true)",
            f"forall x: Heavy (x.level > 2 or x near {a})", "exists x: Item (exists y: Spot (x at y and not y == s))",
            f"exists x: Item (x follows {a} and not x == {a})", f"not exists x: Item ({a} near x and x is Heavy)",
        ))  # fmt: skip


@dataclass
class Body:
    """Writes the body of one compound."""

    writer: Writer
    skills: list[str]
    labels: list[str]
    left: int = 9
    items: tuple[str, ...] = ("a", "b")

    def node(self, depth: int) -> str:
        """Write a node."""
        self.left -= 1
        random = self.writer.random
        if depth == 0 or self.left <= 0 or random.random() < 0.25:
            return self.leaf()
        kind = random.choice(
            ("seq", "seq", "seq", "sel", "par", "reactive", "around", "around", "loop", "if", "with", "handled")
        )
        match kind:
            case "seq" | "sel":
                return f"{kind} {self.nodes(depth, 1, 4)}"
            case "par":
                return f"par {random.choice(('all', 'any', 'race', 'lead'))} {self.nodes(depth, 2, 3)}"
            case "reactive":
                return f"reactive {random.choice(('seq', 'sel'))} {self.nodes(depth, 1, 3)}"
            case "around":
                kind = random.choice(("try", "try", "invert", "once", "timeout 0.2 s", "retry 2"))
                return f"{kind} {self.nodes(depth, 1, 2)}"
            case "loop":
                return self.loop(depth)
            case "if":
                otherwise = f" else {self.nodes(depth, 1, 2)}" if random.random() < 0.5 else ""
                return f"if {self.condition()} {self.nodes(depth, 1, 2)}{otherwise}"
            case "handled":
                word = random.choice(("on failure", "finally"))
                return f"seq {self.nodes(depth, 1, 3)} {word} {self.nodes(depth, 1, 2)}"
            case _:
                return f"with Setup({self.arguments()}) {self.nodes(depth, 1, 2)}"

    def nodes(self, depth: int, least: int, most: int) -> str:
        """Write nodes in braces."""
        count = self.writer.random.randint(least, most)
        return "{\n" + "\n".join(self.node(depth - 1) for _ in range(count)) + "\n}"

    def loop(self, depth: int) -> str:
        """Write a loop."""
        random = self.writer.random
        kind = random.choice(
            ("repeat 2", "repeat 9", "retry 9", "repeat n", "retry n", f"while {self.condition()} max 2", "for")
        )
        if kind != "for":
            return f"{kind} {self.nodes(depth, 1, 2)}"
        variable, outer = f"x{self.left}", self.items
        self.items = (*outer, variable, variable)
        inner = self.nodes(depth, 1, 2)
        self.items = outer
        return f"for {variable} in items() {inner}"

    def leaf(self) -> str:
        """Write a node without children."""
        random = self.writer.random
        kind = random.choice(("call",) * 6 + ("find", "any", "check", "wait", "until", "apply"))
        match kind:
            case "find":
                return f"Find(a: {random.choice(self.items)})"
            case "any":
                return f"Any(s: {random.choice('st')})"
            case "check":
                return f"check({self.condition()})"
            case "wait":
                return "wait 0.1 s"
            case "until" if random.random() < 0.3:
                return f"wait until ({self.condition()})"
            case "apply" if self.labels:
                return f"apply {random.choice(self.labels)}"
        return f"{random.choice(self.skills)}({self.arguments()})"

    def arguments(self) -> str:
        """Write the four arguments of a call."""
        random = self.writer.random
        pick = [random.choice(self.items), random.choice(self.items), random.choice("st"), random.choice("st")]
        return ", ".join(f"{name}: {value}" for name, value in zip("abst", pick, strict=True))

    def condition(self) -> str:
        """Write a condition on what is in scope."""
        return self.writer.condition(self.writer.random.choice(self.items), self.writer.random.choice(self.items))
