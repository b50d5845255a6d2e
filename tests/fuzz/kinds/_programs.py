"""Programs that mean something: a vocabulary, skills over it, and bodies that call them, rightly or nearly so."""

from __future__ import annotations

from random import Random

_CLASSES = ("Cup", "Shelf", "Lift", "Robot2", "Door")
_QUANTITIES = (
    "0",
    "1",
    "12.5",
    "-3",
    "2 N",
    "0.05 m/s",
    "5 cm",
    "1 kg",
    "90 deg",
    "3 s",
    '"ready"',
    "true",
    "lab:Thing-1",
)
_DIMENSIONS = ("Length", "Force", "Number", "Int", "Bool", "Text", "Pose", "Vector", "Time", "Mass")
_BLOCKS = (
    "seq",
    "sel",
    "par all",
    "par any",
    "par race",
    "par lead",
    "reactive seq",
    "reactive sel",
    "try",
    "invert",
    "once",
)
_COUNTS = (
    "retry 3",
    "repeat 2",
    "timeout 5 s",
    "while {c} max 3",
    "if {c}",
    "for x in [1, 2]",
    "timeout -1 s",
    "retry 0",
)
_PYTHON = 'run python "skillc.primitives:StandIn"'


class _Writer:
    """Draws one program; most names that it uses are declared."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.classes = list(_CLASSES[: random.randint(1, 4)])
        self.relations = [f"rel{n}" for n in range(random.randint(1, 3))]
        self.properties = [f"prop{n}" for n in range(random.randint(1, 3))]
        self.skills: dict[str, list[str]] = {}

    def program(self) -> str:
        lines = ["use skiros, rparts", "prefix lab: <http://example.org/lab#>", *self._vocabulary()]
        for number in range(self.random.choice((1, 1, 2))):
            lines += self._skill(f"Do{number}")
        for number in range(self.random.choice((0, 1, 1))):
            lines += self._compound(number)
        if self.random.random() < 0.3:
            lines += ["task t {", f"    goal {self._condition(['lab:A', 'lab:B'], 2)}", "}"]
        return "\n".join(lines) + "\n"

    def _vocabulary(self) -> list[str]:
        pick = self.random.choice
        lines = [f"class {name} < {pick(['Product', 'Location', 'Thing', *self.classes])}" for name in self.classes]
        axioms = (
            "",
            "functional",
            "symmetric",
            "transitive",
            "asymmetric",
            "irreflexive",
            "inverse back",
            "sub contain",
        )
        lines += [
            f"relation {name}({pick(self.classes)}, {pick(self.classes)})  {pick(axioms)}" for name in self.relations
        ]
        return lines + [f"property {name}({pick(self.classes)}): {pick(_DIMENSIONS)}" for name in self.properties]

    def _skill(self, name: str) -> list[str]:
        pick, names = self.random.choice, [f"p{n}" for n in range(self.random.randint(1, 4))]
        lines = [f"skill {name} {{"]
        for each in names:
            kind = pick([*self.classes, *self.classes, pick(_DIMENSIONS)])
            default = f" = {self._value(names, 1)}" if self.random.random() < 0.2 else ""
            lines.append(f"    {pick(['in', 'in', 'infer', 'opt', 'out', 'infer any'])} {each}: {kind}{default}")
        for member in ("pre", "hold", "post", "post"):
            if self.random.random() < 0.7:
                label = f"l{len(lines)}: " if self.random.random() < 0.5 else ""
                lines.append(f"    {member} {label}{self._condition(names, 2)}")
        if self.random.random() < 0.4:
            lines.append(f"    duration {self._value(names, 2)}")
        if self.random.random() < 0.3:
            lines.append(f"    {pick(['uses', 'shares'])} {pick(names)}")
        if self.random.random() < 0.3:
            lines.append(
                f"    pause {pick(['anywhere', 'between steps', 'never'])}{pick(['', ' keep 2 s', ' keep 0 N'])}"
            )
        self.skills[name] = names
        return [*lines, "}", f"impl {name.lower()} of {name} {{", f"    {_PYTHON}", "}"]

    def _compound(self, number: int) -> list[str]:
        name = self.random.choice(sorted(self.skills))
        lines = [f"impl whole{number} of {name} {{"]
        if self.random.random() < 0.4:
            lines.append(f"    let extra = {self._value(self.skills[name], 2)}")
        return [*lines, f"    do {self._node(self.skills[name], 3)}", "}"]

    def _node(self, names: list[str], depth: int) -> str:
        pick = self.random.choice
        if depth == 0 or self.random.random() < 0.3:
            return self._leaf(names)
        inner = "\n".join(self._node(names, depth - 1) for _ in range(self.random.choice([0, 1, 1, 2, 3])))
        head = pick([pick(_BLOCKS), pick(_BLOCKS), pick(_COUNTS), f"with {self._call(names)}"])
        return f"{head.format(c=self._condition(names, 1))} {{\n{inner}\n}}"

    def _leaf(self, names: list[str]) -> str:
        pick = self.random.choice
        return pick(
            [
                self._call(names),
                self._call(names),
                "wait 1 s",
                f"wait until {self._condition(names, 1)}",
                f"check({self._condition(names, 1)})",
                f"apply l{self.random.randint(3, 7)}",
            ]
        )

    def _call(self, names: list[str]) -> str:
        skill = self.random.choice(sorted(self.skills))
        given = [f"{each}: {self._value(names, 1)}" for each in self.skills[skill] if self.random.random() < 0.7]
        result = f" -> {self.random.choice(['made', *names])}" if self.random.random() < 0.1 else ""
        return f"{skill}({', '.join(given)}){result}"

    def _condition(self, names: list[str], depth: int) -> str:
        pick, value = self.random.choice, lambda: self._value(names, 1)
        if depth and self.random.random() < 0.4:
            inner, other = self._condition(names, depth - 1), self._condition(names, depth - 1)
            quantified = self._condition([*names, "v"], depth - 1)
            return pick(
                [
                    f"not ({inner})",
                    f"({inner} {pick(['and', 'or', 'implies'])} {other})",
                    f"{pick(['exists', 'forall'])} v: {pick(self.classes)} ({quantified})",
                ]
            )
        return pick(
            [
                f"{pick(names)} {pick(self.relations)} {pick([*names, '_'])}",
                f"{value()} {pick(self.relations)} {value()}",
                f"{pick(names)}.{pick(self.properties)} {pick(['==', '!=', '<', '>='])} {value()}",
                f"given {pick(names)}",
                f"{pick(names)} has {pick(self.properties)}",
                f"{value()} == {value()}",
                f"{value()} is {pick(self.classes)}",
            ]
        )

    def _value(self, names: list[str], depth: int) -> str:
        pick = self.random.choice
        if depth and self.random.random() < 0.25:
            one, other = self._value(names, depth - 1), self._value(names, depth - 1)
            return pick([f"({one} {pick('+-*/')} {other})", f"offset({one}, {other})", f"[{one}, {other}]"])
        return pick([pick(names), pick(names), f"{pick(names)}.{pick(self.properties)}", pick(_QUANTITIES)])


def write_program(random: Random) -> str:
    """Return a program drawn at random."""
    return _Writer(random).program()
