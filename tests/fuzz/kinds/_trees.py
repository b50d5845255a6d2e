"""Libraries of skills whose values have types: every type as a parameter, constant, output and loop variable.

Names and texts are such as a format of trees may take for something of its own. What is written compiles, but for what
a checker knows of paths: a library that it refuses is another draw.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

NAMES = (
    *("Root", "TryCatch", "Sequence", "Sleep", "Switch2", "SubTree", "Action", "ForEach", "With", "Try", "Parallel"),
    *(
        "RunOnce",
        "Undefined",
        "TreeNodesModel",
        "BehaviorTree",
        "xml",
        "größe",
        "task_go",
        "go",
        "way0",
        "a_xe4_",
        "Gö",
    ),
)
VARIABLES = (
    "ID",
    "name",
    "value",
    "value_",
    "n",
    "x__1",
    "x__given",
    "text__1",
    "type",
    "Ä",
    "m",
    "_o",
    "port",
    "msec",
)
TYPES = ("Item", "Number", "Length", "Int", "Bool", "Text", "Pose")
LISTS = {"Item": "items()", "Number": "levels()", "Int": "counts()", "Text": "words()"}
LITERALS = {
    "Number": ("0", "1", "12", "-3", "0.5", "1e3", "1e-9", "123456789012345", "0.1", "1e15"),
    "Length": ("5 cm", "12 m", "0.25 m", "0 m", "-1 mm", "1000000 m"),
    "Int": ("0", "7", "-4", "2147483647", "2147483648", "99999999999"),
    "Bool": ("true", "false"),
    "Text": (
        *('"12"', '"-1.5"', '"1e5"', '"nan"', '"inf"', '""', '"="', '"{a}"', '" {a} "', '"{=}"', '"json:[1]"', '" x "'),
        *('"true"', '"a;b,c"', '"it\'s"', '"<&>"', '"\\"', '"ä😀"', '"ok"', '"\t"', '"0x1F"', '"RED"', '"]]>"', '"--"'),
    ),
    "Item": ("lab:A-1", "lab:B"),
}
TIMES = ("0.2 s", "1 s", "5 s", "1000000 s")
PROPERTIES = {"Number": "level", "Length": "size", "Int": "count", "Bool": "on", "Text": "word"}
VOCABULARY = """\
prefix lab: <http://example.org/lab#>
class Item
class Tool < Item
relation near(Item, Item)
property level(Item): Number
property size(Item): Length
property count(Item): Int
property on(Item): Bool
property word(Item): Text
function items() -> [Item] = python "analysis.actors:items"
function levels() -> [Number] = python "analysis.actors:items"
function counts() -> [Int] = python "analysis.actors:items"
function words() -> [Text] = python "analysis.actors:items"
function spot(a: Item) -> Pose = python "analysis.actors:items"
"""
Parameters = list[tuple[str, str, str]]
"""Direction, name and type."""


class Writer:
    """Writes one library."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.names = random.sample(NAMES, 8)
        self.skills: dict[str, Parameters] = {}
        self.scoped: set[str] = set()

    def library(self) -> str:
        """Return the text."""
        primitives = [self.primitive(self.names.pop()) for _ in range(self.random.randint(2, 4))]
        compounds = [self.compound(self.names.pop()) for _ in range(self.random.randint(1, 3))]
        return "\n".join([VOCABULARY, *primitives, *compounds, self.task()]) + "\n"

    def primitive(self, name: str) -> str:
        """Write a skill that Python does."""
        scoped = self.random.random() < 0.3
        parameters, head = self.head(name, "    scoped\n" if scoped else "")
        text = head + "".join(
            f'impl way{number} of {name} {{ run python "tree.stage:Scripted" }}\n'
            for number in range(self.random.choice((1, 1, 2)))
        )
        self.skills[name] = parameters
        if scoped:
            self.scoped.add(name)
        return text

    def compound(self, name: str) -> str:
        """Write a skill with a body."""
        parameters, head = self.head(name, "", calls=True)
        scope = {each: type_ for direction, each, type_ in parameters if direction in ("in", "infer")}
        outputs = {each: type_ for direction, each, type_ in parameters if direction == "out"}
        body = Body(self, {**scope}, {**outputs})
        lets = body.lets()
        steps = [body.node(3) for _ in range(self.random.randint(1, 3))]
        steps += [made for made in map(body.assigned, outputs) if made]
        self.skills[name] = parameters
        return f"{head}impl body of {name} {{\n{lets}    do seq {{\n" + "\n".join(steps) + "\n}\n}\n"

    @property
    def made(self) -> set[str]:
        """The types of which some skill has an output."""
        return {type_ for each in self.skills.values() for direction, _, type_ in each if direction == "out"}

    def task(self) -> str:
        """Write a task by hand."""
        body = Body(self, {}, {})
        return "task go {\n    do seq {\n" + "\n".join(body.node(2) for _ in range(2)) + "\n}\n}"

    def head(self, name: str, flags: str, calls: bool = False) -> tuple[Parameters, str]:
        """Write a description."""
        names = self.random.sample(VARIABLES, self.random.randint(1, 5))
        parameters: Parameters = [("in", "a", "Item")]
        lines = [f"skill {name} {{", "    in a: Item"]
        for each in names:
            type_, direction = self.random.choice(TYPES), self.random.choice(("in", "in", "opt", "opt", "out", "infer"))
            made = type_ in self.made or not calls
            if direction == "out" and (not made or any(each[0] == "out" for each in parameters)):
                direction = "in"
            type_ = "Item" if direction == "infer" else type_
            default = direction == "opt" and type_ in LITERALS and type_ != "Item" and self.random.random() < 0.8
            lines.append(f"    {direction} {each}: {type_}" + (f" = {self.literal(type_)}" if default else ""))
            if direction == "infer":
                lines.append(f"    pre a near {each}")
            parameters.append((direction, each, type_))
        if self.random.random() < 0.3:
            lines.append(f"    {self.random.choice(('pre', 'hold', 'hold', 'hold'))} a.level < 3")
        return parameters, "\n".join(lines) + f"\n{flags}    noplan\n}}\n"

    def literal(self, type_: str) -> str:
        """Write a constant."""
        return self.random.choice(LITERALS[type_])


class Body:
    """Writes nodes; `scope` are names that have values, `taken` all others that are in scope."""

    def __init__(self, writer: Writer, scope: dict[str, str], outputs: dict[str, str]) -> None:
        self.writer, self.random = writer, writer.random
        self.scope, self.taken = scope, outputs

    def lets(self) -> str:
        """Write values with names."""
        text = ""
        for name in ("let_n", "let_t"):
            if self.random.random() < 0.4:
                type_ = self.random.choice(("Number", "Length", "Text", "Bool", "Int"))
                text += f"    let {name} = {self.value(type_)}\n"
                self.scope[name] = type_
        return text

    def node(self, depth: int) -> str:
        """Write a node."""
        if depth == 0 or self.random.random() < 0.35:
            return self.leaf()
        make = self.random.choice((*self.forms, self.block))
        return make(depth - 1)

    @property
    def forms(self) -> tuple[Callable[[int], str], ...]:
        """What writes each kind of node that has others in it."""
        looping = self.loop if self.random.random() < 0.5 else self.loop_over_individuals
        return (self.block, self.handled, self.apart, self.one, looping, self.choice, self.around)

    def handled(self, depth: int) -> str:
        """Write a block with what is done when it failed, and in the end."""
        words = self.random.choice((("on failure",), ("finally",), ("on failure", "finally")))
        ends = "".join(f" {word} {{\n{self.inside(depth // 2)}\n}}" for word in words)
        head = f"with {self.call(self.random.choice(sorted(self.writer.scoped)))}" if self.writer.scoped else "seq"
        return f"{self.random.choice((head, 'seq', 'sel'))} {{\n{self.inside(depth)}\n}}{ends}"

    def block(self, depth: int) -> str:
        inner = "\n".join(self.node(depth) for _ in range(self.random.randint(1, 3)))
        return f"{self.random.choice(('seq', 'seq', 'reactive seq'))} {{\n{inner}\n}}"

    def apart(self, depth: int) -> str:
        head = self.random.choice(("sel", "reactive sel", "par all", "par any", "par race", "par lead"))
        return f"{head} {{\n" + "\n".join(self.inside(depth) for _ in range(self.random.randint(2, 3))) + "\n}"

    def one(self, depth: int) -> str:
        forms = ("retry {n}", "repeat {n}", "timeout {t}", "try", "invert", "once", "while a.level < 3 max {n}")
        form = self.random.choice(forms if self.has_a() else forms[:-1])
        head = form.format(n=self.random.choice((1, 2, 3, 1000000)), t=self.random.choice(TIMES))
        return f"{head} {{\n{self.inside(depth)}\n}}"

    def loop(self, depth: int) -> str:
        kind, items = self.random.choice(list(LISTS.items()))
        name = self.fresh(("i", "j", "m2"))
        if name is None:
            return self.leaf()
        before = dict(self.scope)
        self.scope[name] = kind
        inner = "\n".join(self.node(depth) for _ in range(2))
        self.forget(before)
        self.taken.pop(name, None)
        return f"for {name} in {items} {{\n{inner}\n}}"

    def loop_over_individuals(self, depth: int) -> str:
        """Write a loop over those of which something holds, in order at times, or over some that are named."""
        name = self.fresh(("i", "j", "m2"))
        if name is None or not self.has_a():
            return self.leaf()
        places = [each for each, type_ in self.scope.items() if type_ == "Item"]
        before = dict(self.scope)
        self.scope[name] = "Item"
        inner = self.inside(depth)
        self.forget(before)
        self.taken.pop(name, None)
        order = self.random.choice(("", f" by {name}.level", f" by -{name}.count"))
        where = self.random.choice(("a near {x}", "{x}.on == true and not a near {x}", "{x}.level > a.level"))
        several = f": {self.random.choice(('Item', 'Tool'))} where {where.format(x=name)}{order}"
        named = f" in [{', '.join(self.random.choices((*places, 'lab:A-1'), k=self.random.randint(1, 3)))}]"
        return f"for {name}{self.random.choice((several, several, named))} {{\n{inner}\n}}"

    def choice(self, depth: int) -> str:
        if not self.has_a():
            return self.leaf()
        other = f" else {{\n{self.inside(depth)}\n}}" if self.random.random() < 0.7 else ""
        return (
            f"if a.level {self.random.choice(('==', '>'))} {self.value('Number')} {{\n{self.inside(depth)}\n}}{other}"
        )

    def around(self, depth: int) -> str:
        if not self.writer.scoped:
            return self.leaf()
        head = self.call(self.random.choice(sorted(self.writer.scoped)))
        return f"with {head} {{\n{self.inside(depth)}\n}}"

    def inside(self, depth: int) -> str:
        """Write a node whose names have values only there."""
        before, text = dict(self.scope), self.node(depth)
        self.forget(before)
        return text

    def forget(self, before: dict[str, str]) -> None:
        self.taken.update({name: type_ for name, type_ in self.scope.items() if name not in before})
        self.scope = before

    def leaf(self) -> str:
        kind = self.random.random()
        if kind < 0.04:
            return 'fail "it is so"'
        if kind < 0.1:
            return f"wait {self.random.choice(TIMES)}"
        if kind < 0.2 and self.has_a():
            return self.random.choice((f"check(a.level == {self.value('Number')})", "wait until a.on == true"))
        return self.call(self.random.choice(sorted(self.writer.skills)))

    def call(self, skill: str) -> str:
        """Write a call, with its output named at times."""
        given = []
        for direction, name, type_ in self.writer.skills[skill]:
            if direction == "in" or (direction in ("opt", "infer") and self.random.random() < 0.4):
                given.append(f"{name}: {self.value(type_)}")
        out = [type_ for direction, _, type_ in self.writer.skills[skill] if direction == "out"]
        target = ""
        if out and self.random.random() < 0.8:
            target = self.target(out[0])
        return f"{skill}({', '.join(given)}){target}"

    def target(self, type_: str) -> str:
        """Write where an output goes: a new name, or one that is there and that it fits."""
        known = {**self.taken, **self.scope}
        fitting = [
            each for each in ("u", "v", "w") if known.get(each) in (type_, None) or self.fits(type_, known[each])
        ]
        if not fitting:
            return ""
        name = self.random.choice(fitting)
        self.scope[name] = known.get(name, type_)
        self.taken.pop(name, None)
        return f" -> {name}"

    def assigned(self, output: str) -> str:
        """Write a call that gives the skill's own output its value; nothing if no skill returns such a value."""
        for skill, parameters in sorted(self.writer.skills.items()):
            if any(each == "out" and self.fits(type_, self.taken[output]) for each, _, type_ in parameters):
                given = [f"{name}: {self.value(type_)}" for each, name, type_ in parameters if each == "in"]
                return f"{skill}({', '.join(given)}) -> {output}"
        return ""

    @staticmethod
    def fits(given: str, wanted: str) -> bool:
        return given == wanted or (given, wanted) == ("Int", "Number")

    def value(self, type_: str) -> str:
        """Write a value: a name, a property, a constant, a computation."""
        options = [name for name, each in self.scope.items() if self.fits(each, type_)]
        options += [self.writer.literal(type_) for _ in range(2) if type_ in LITERALS]
        if self.has_a() and type_ in PROPERTIES:
            options.append(f"a.{PROPERTIES[type_]}")
        if type_ in ("Number", "Length") and self.random.random() < 0.3:
            options = [f"({self.value(type_)} {self.random.choice('+-')} {self.random.choice(options)})"]
        if type_ == "Pose":
            options.append(f"spot({self.value('Item')})")
        return self.random.choice(options)

    def has_a(self) -> bool:
        return "a" in self.scope

    def fresh(self, names: tuple[str, ...]) -> str | None:
        free = [each for each in names if each not in self.scope and each not in self.taken]
        return self.random.choice(free) if free else None


def write_library(random: Random) -> str:
    """Return a library drawn at random."""
    return Writer(random).library()
