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
property level(Item): Number  range 0 .. 6
enum Grade { Good, Bad, Odd }
property grade(Item): Grade
relation isIn(x: Item, s: Spot) = x at s or exists y: Item (y near x and y at s)
relation leads(x: Item, y: Item) = x near y or exists z: Item (x follows z and z leads y)
function items() -> [Item] = python "analysis.actors:items"
"""
PLAIN = "    in a: Item\n    in b: Item\n    in s: Spot\n    in t: Spot\n"
JUDGES = f"""
skill Judge {{
{PLAIN}    senses a.grade
    outcome good: a.grade == Good
    outcome bad: a.grade == Bad
    outcome odd: a.grade == Odd and a at s
    noplan
}}
impl one of Judge {{ run python "analysis.actors:Judge" }}
skill Guess {{
{PLAIN}    outcome on: a.on == true and b at s
    outcome off: a.on == false and not b at s
    noplan
}}
impl one of Guess {{ run python "analysis.actors:Judge" }}
"""
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
        text += JUDGES + self.spread()
        text += self.primitive("Setup", "    scoped\n")
        return text + "".join(self.compound(n) for n in range(COMPOUNDS))

    def primitive(self, name: str, more: str = "") -> str:
        """Write a skill with two implementations that chance plays."""
        posts = {self.promise() for _ in range(self.random.randint(0, 2))}
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
        posts = "".join(f"    post {label}: {self.promise()}\n" for label in labels)
        more = ["Sense", "Setup", "Judge", "Guess", "Spread"]
        callable_ = [f"P{n}" for n in range(PRIMITIVES)] + more + [f"C{n}" for n in range(number)] * 2
        body = Body(self, callable_, labels).node(4)
        lines = "".join(f"    verify {self.property(callable_)}\n" for _ in range(2))
        count = f"    opt n: Int = {self.random.randint(1, 3)}  range 1 .. 3\n"
        head = f"skill C{number} {{\n{PLAIN}{count}{self.needs()}{posts}    noplan\n}}\n"
        return f"{head}impl body of C{number} {{\n    do {body}\n{lines}}}\n"

    def spread(self) -> str:
        """Write a primitive with an effect on many, which compounds often promise as well."""
        text = f"skill Spread {{\n{PLAIN}    post {self.effect_on_many()}\n    noplan\n}}\n"
        return text + 'impl one of Spread { run python "analysis.actors:Actor" }\n'

    def promise(self) -> str:
        """Write a postcondition."""
        kind = self.random.random()
        return self.effect_on_many() if kind < 0.2 else self.change() if kind < 0.35 else self.literal()

    def change(self) -> str:
        """Write a change of a number."""
        return self.random.choice((
            "a.level += 1", "a.level -= 1 .. 2", "b.level += a.level", "a.level := 2", "a.level -= 0 .. _",
            "a.level += 0 .. 3", "b.level := b.level + 2", "forall x: Item (x.level += 1 when x at s)",
            "forall x: Item (x.level += 0 .. 2 when x at s)", "a.level := _", "a.level += 2", "a.level += 1 .. 4",
        ))  # fmt: skip

    def effect_on_many(self) -> str:
        """Write an effect on all individuals of a class that fulfil a condition; one library has few of them."""
        return self.random.choice((
            "forall x: Item (x.on == true when x at s)", "forall x: Item (x at t when x at s and x.on == true)",
            "forall x: Heavy (not x near a when x.level > 2)", "forall x: Item (x.grade == Bad when x near a)",
            "forall x: Item (not x at s when x isIn s)", "forall x: Item (x.level == 1)",
        ))  # fmt: skip

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
            f"{one}.grade == {self.grade()}", f"not {one}.grade == {self.grade()}",
        )  # fmt: skip
        return self.random.choice(forms)

    def grade(self) -> str:
        """Write a value of the enumeration."""
        return self.random.choice(("Good", "Bad", "Odd"))

    def condition(self, a: str = "a", b: str = "b") -> str:
        """Write a condition."""
        one = self.literal(a, b)
        more = (
            f"{a} == {b}", f"not {a} == {b}", f"{a} is Heavy", f"{b} has level", f"{a}.level > 2", f"{b} at _",
            "_ at s", "exists x: Item (x at s)", f"not {one}" if not one.startswith("not") else one,
            f"({one} or {b}.on == true)", f"({one} and {a}.level <= 3)", f"{a} has grade", f"not {b} has grade",
            f"{a} isIn s", f"not {b} isIn s", f"{a} leads {b}", f"not {a} leads {b}", f"{a}.at == s",
            f"{a}.at == {b}.at", f"({a}.grade == Good or {a}.grade == Odd)", f"{a} isIn s implies {b} isIn s",
        )  # fmt: skip
        several = self.quantified(a), self.quantified(b), self.counted(a)
        return self.random.choice((one, one, one, *more, *several))

    def counted(self, a: str) -> str:
        """Write a comparison of a count or a sum."""
        return self.random.choice((
            "count(x: Item where x at s) < 2", f"count(x: Item where x near {a}) >= 1", "count(x: Heavy) == 1",
            "count(x: Item where x.on == true) > 1", "sum(x: Item where x at t and x has level, x.level) <= 3",
            f"max(x: Item where x has level, x.level) == {a}.level", "count(x: Item where x.grade == Bad) != 0",
        ))  # fmt: skip

    def quantified(self, a: str) -> str:
        """Write a condition on all individuals of a class, or some one."""
        return self.random.choice((
            "exists x: Heavy (x at s)", "not exists x: Item (s holds x)", "forall x: Item (not x at t)",
            f"exists x: Item ({a} near x)", f"exists x: Spot ({a} at x)", f"forall x: Spot (not {a} touches x)",
            "exists x: Item (x at s and x.on == true)", "forall x: Item (x at s implies x.on == true)",
            f"forall x: Heavy (x.level > 2 or x near {a})", "exists x: Item (exists y: Spot (x at y and not y == s))",
            f"exists x: Item (x follows {a} and not x == {a})", f"not exists x: Item ({a} near x and x is Heavy)",
            f"forall x: Item (x isIn s implies x.grade == Good or x == {a})", "forall x: Item (x has grade)",
            f"exists x: Item (x.grade == Bad and not x leads {a})", "not exists x: Item (x at s and x.on == false)",
            "exists x: Heavy, y: Item (x near y and y.on == true)", f"forall x: Item, y: Spot (not x at y or x == {a})",
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
                block = random.choice(("seq", "seq", "sel", "par all", f"with Setup({self.arguments()})"))
                ends = random.choice((("on failure",), ("finally",), ("on failure", "finally")))
                last = "".join(f" {word} {self.nodes(depth, 1, 2)}" for word in ends)
                return f"{block} {self.nodes(depth, 1, 3)}{last}"
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
            (
                "repeat 2",
                "repeat 9",
                "retry 9",
                "repeat n",
                "retry n",
                f"while {self.condition()} max 2",
                "while",
                "for",
                "of",
                "each",
                "each",
            )
        )
        if kind == "while":
            kind = f"while {self.condition()} max {random.randint(1, 9)}"
        if kind not in ("for", "of", "each"):
            return f"{kind} {self.nodes(depth, 1, 2)}"
        variable, outer = f"x{self.left}", self.items
        self.items = (*outer, variable, variable)
        inner = self.nodes(depth, 1, 2)
        self.items = outer
        if kind == "each":
            where = f"where {self.writer.condition(variable, random.choice(outer))}"
            return f"for {variable}: Item {where}{random.choice(('', f' by {variable}.level'))} {inner}"
        several = "items()" if kind == "for" else f"[{', '.join(random.choices(outer, k=random.randint(1, 3)))}]"
        return f"for {variable} in {several} {inner}"

    def leaf(self) -> str:
        """Write a node without children."""
        random = self.writer.random
        kind = random.choice(("call",) * 6 + ("find", "any", "check", "wait", "until", "apply", "fail"))
        match kind:
            case "find":
                return f"Find(a: {random.choice(self.items)})"
            case "any":
                return f"Any(s: {random.choice('st')})"
            case "check":
                return f"check({self.condition()})"
            case "wait":
                return "wait 0.1 s"
            case "fail" if random.random() < 0.5:
                return 'fail "it is so"'
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
