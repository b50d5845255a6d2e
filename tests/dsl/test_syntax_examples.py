"""The language's examples mean what its definition says."""

import msgspec
import pytest
from examples import ALL, EVERYTHING, PICK, TASKS, VOCABULARY, WHOLE, WIPE

from skillc_dsl import syntax as s
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source


def read(text: str) -> s.File:
    outcome = parse(Source("example.skill", text))
    assert outcome.diagnostics == ()
    return outcome.value


def implementation(body: str) -> tuple[s.ImplementationMember, ...]:
    declaration = read(f"impl x of Y {{\n{body}\n}}").declarations[0]
    assert isinstance(declaration, s.ImplementationDeclaration)
    return declaration.members


def condition(text: str) -> s.Condition:
    member = implementation(f"pre {text}")[0]
    assert isinstance(member, s.Requirement)
    return member.condition


def shape(node: object) -> object:
    """The tree without its places."""
    if isinstance(node, tuple):
        return tuple(shape(child) for child in node)
    if not isinstance(node, msgspec.Struct):
        return node
    if isinstance(node, s.Name):
        return node.text
    fields = (getattr(node, name) for name in node.__struct_fields__ if name != "span")
    return (type(node).__name__, *(shape(field) for field in fields))


@pytest.mark.parametrize("name", ALL)
def test_every_example_parses(name: str) -> None:
    assert read(ALL[name]).declarations


def test_the_vocabulary() -> None:
    file = read(VOCABULARY)
    assert [type(h).__name__ for h in file.header] == ["Use", "Prefix", "Import"]
    assert shape(file.header[1]) == ("Prefix", "lab", "http://example.org/lab#")
    board, eraser, *_, at, holds, force, _, lanes = file.declarations
    assert shape(board) == ("ClassDeclaration", "Whiteboard", ("Surface",), (), "", ())
    assert shape(eraser) == ("ClassDeclaration", "Eraser", ("Tool",), ("Gripper",), "", ())
    assert shape(at) == ("RelationDeclaration", "at", "Thing", "Location", (("Trait", "functional", None),), "", None)
    assert isinstance(holds, s.RelationDeclaration)
    assert [(t.kind, t.name and t.name.text) for t in holds.traits] == [
        ("inverse", "heldBy"),
        ("symmetric", None),
        ("transitive", None),
        ("sub", "touches"),
    ]
    assert shape(force) == ("PropertyDeclaration", "normalForce", "Surface", "Force", "", None)
    assert isinstance(lanes, s.FunctionDeclaration)
    assert [p.name.text for p in lanes.parameters] == ["surface", "width", "overlap"]
    assert shape(lanes.result) == ("ListOf", "Pose")
    assert lanes.python.value == "skillc_runtime.motion.lanes:lanes"


def test_a_skill() -> None:
    (pick,) = read(PICK).declarations
    assert isinstance(pick, s.SkillDeclaration)
    assert pick.doc.startswith("Take `object` out of its location.")
    parameters = [m for m in pick.members if isinstance(m, s.Parameter)]
    assert [p.direction for p in parameters] == ["in", "in", "infer", "infer", "infer", "infer", "opt"]
    assert shape(parameters[-1].default) == ("Quantity", 0.25, "m/s")
    assert shape(parameters[-1].range) == ("Range", ("Quantity", 0.01, "m/s"), ("Quantity", 0.5, "m/s"))
    requirements = [m for m in pick.members if isinstance(m, s.Requirement)]
    assert [r.label.text if r.label else None for r in requirements] == [
        "mounted", "there", None, None, "empty", "ready", "held", "gone",
    ]  # fmt: skip
    assert requirements[4].text == "not gripper contain _"
    assert shape(requirements[5].condition) == (
        "Compare",
        ("Member", ("NameReference", "arm"), "deviceState"),
        "!=",
        ("NameReference", "Fault"),
    )


def test_an_implementation() -> None:
    wipe, gripper = read(WIPE).declarations
    assert isinstance(wipe, s.ImplementationDeclaration)
    assert isinstance(gripper, s.ImplementationDeclaration)
    assert wipe.doc.count("\n") == 1
    body = wipe.members[-1]
    assert isinstance(body, s.Body)
    assert isinstance(body.node, s.Block)
    move, with_, *_ = body.node.children
    assert isinstance(move, s.CallSkill)
    assert [shape(a) for a in move.arguments] == [
        ("Argument", "arm", ("NameReference", "arm")),
        ("Argument", "target", ("NameReference", "above")),
        ("Argument", "speed", ("NameReference", "speed")),
    ]
    assert isinstance(with_, s.With)
    assert with_.call.skill.text == "Compliance"
    assert shape(gripper.members[-1]) == (
        "RunPython",
        ("Text", "skillc_runtime.primitives.gripper:ParallelGripper"),
    )


def test_tasks() -> None:
    planned, by_hand = read(TASKS).declarations
    assert isinstance(planned, s.TaskDeclaration)
    assert isinstance(by_hand, s.TaskDeclaration)
    assert planned.goal_text == "lab:Whiteboard-1.isClean == true"
    assert planned.scene is not None
    assert planned.scene.value == "scenes/ur5e_whiteboard.ttl"
    assert (planned.body, by_hand.goal) == (None, None)
    assert by_hand.body is not None


def test_parameters_carry_their_documentation() -> None:
    everything, _ = read(EVERYTHING).declarations
    assert isinstance(everything, s.SkillDeclaration)
    arm, place, *_ = everything.members
    assert isinstance(arm, s.Parameter)
    assert isinstance(place, s.Parameter)
    assert arm.doc == "Which arm.\nOn two lines."
    assert (place.any, place.doc) == (True, "")


def test_the_patterns_of_verify() -> None:
    found = [
        shape(member)
        for line in ("never A outside B", "A before B", "after A eventually B", "never force > 25 N")
        for member in implementation(f"verify {line}")
    ]
    force = ("Compare", ("NameReference", "force"), ">", ("Quantity", 25.0, "N"))
    assert found == [
        ("Verify", "outside", ("VerifyEvent", "A"), ("VerifyEvent", "B")),
        ("Verify", "before", ("VerifyEvent", "A"), ("VerifyEvent", "B")),
        ("Verify", "eventually", ("VerifyEvent", "A"), ("VerifyEvent", "B")),
        ("Verify", "never", ("VerifyEvent", force), None),
    ]


ONE, TWO, THREE = (("Number", float(digit), digit) for digit in "123")
A, B, C = (("Bare", ("NameReference", name)) for name in "abc")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a and b and c", ("And", (A, B, C))),
        ("(a and b) and c", ("And", (A, B, C))),
        ("a or b and c", ("Or", (A, ("And", (B, C))))),
        ("a implies b implies c", ("Implies", A, ("Implies", B, C))),
        ("not a or b", ("Or", (("Not", A), B))),
        ("_ contain a", ("Relation", ("Anything",), "contain", ("NameReference", "a"))),
        ("a has b", ("Has", ("NameReference", "a"), "b")),
        ("a is lab:B-1", ("Is", ("NameReference", "a"), "lab:B-1")),
        ("given a", ("Given", "a")),
        ("exists x: C (a)", ("Quantified", "exists", "x", "C", A, None)),
    ],
)
def test_conditions(text: str, expected: object) -> None:
    assert shape(condition(text)) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", ("Arithmetic", "+", ONE, ("Arithmetic", "*", TWO, THREE))),
        ("1 - 2 - 3", ("Arithmetic", "-", ("Arithmetic", "-", ONE, TWO), THREE)),
        ("1 - (2 - 3)", ("Arithmetic", "-", ONE, ("Arithmetic", "-", TWO, THREE))),
        ("a - 5 N", ("Arithmetic", "-", ("NameReference", "a"), ("Quantity", 5.0, "N"))),
        ("a-5 N", ("Arithmetic", "-", ("NameReference", "a"), ("Quantity", 5.0, "N"))),
        ("-1.5e-3 m", ("Quantity", -0.0015, "m")),
        ("2.0", ("Number", 2.0, "2.0")),
        ("8 N/area", ("Arithmetic", "/", ("Quantity", 8.0, "N"), ("NameReference", "area"))),
        ("f(a, 1).x", ("Member", ("Invoke", "f", (("NameReference", "a"), ("Number", 1.0, "1"))), "x")),
        ('"a # b"', ("Text", "a # b")),
    ],
)  # fmt: skip
def test_values(text: str, expected: object) -> None:
    (let,) = implementation(f"let x = {text}")
    assert isinstance(let, s.Let)
    assert shape(let.value) == expected


def test_a_condition_is_kept_as_written_on_one_line() -> None:
    (member,) = implementation('pre a ==  b   # why\n  and (c.d == "x # y"\n or e)')
    assert isinstance(member, s.Requirement)
    assert member.text == 'a == b and (c.d == "x # y" or e)'


@pytest.mark.parametrize(
    "word",
    [
        *("any", "max", "range", "goal", "scene", "check", "wait", "duration", "retry", "all"),
        *("pause", "anywhere", "between", "steps", "keep"),
    ],
)
def test_words_with_one_place_are_names_elsewhere(word: str) -> None:
    members = implementation(f"refine {word}: {word}\nlet {word} = {word}.{word} + {word}({word})\npre given {word}")
    assert len(members) == 3


@pytest.mark.parametrize(
    "word", ["never", "after", "until", "sensed", "check", "wait", "range", "any", "anywhere", "between", "steps"]
)
def test_words_with_one_place_are_relations_elsewhere(word: str) -> None:
    assert shape(condition(f"a {word} b")) == ("Relation", ("NameReference", "a"), word, ("NameReference", "b"))


@pytest.mark.parametrize("word", ["pause", "anywhere", "between", "steps", "keep"])
def test_words_of_pauses_are_called_skills_elsewhere(word: str) -> None:
    (body,) = implementation(f"do seq {{ wait time\n{word}(arm)\n{word}[{word}]({word}: 2) -> {word} }}")
    assert isinstance(body, s.Body) and isinstance(body.node, s.Block)
    assert [type(node) for node in body.node.children] == [s.Wait, s.CallSkill, s.CallSkill]


@pytest.mark.parametrize(
    ("line", "where", "keep"),
    [
        ("pause anywhere", "anywhere", None),
        ("pause between steps", "between steps", None),
        ("pause never", "never", None),
        ("pause anywhere keep 2 s", "anywhere", ("Quantity", 2.0, "s")),
        ("pause between\n steps keep\n -1 min", "between steps", ("Quantity", -1.0, "min")),
    ],
)
def test_a_pause_says_where_and_how_long(line: str, where: str, keep: object) -> None:
    skill = read(f"skill Wipe {{ pre ready {line} scoped pre done }}").declarations[0]
    assert isinstance(skill, s.SkillDeclaration)
    before, pause, flag, after = skill.members
    assert isinstance(pause, s.Pause) and isinstance(flag, s.Flag)
    assert isinstance(before, s.Requirement) and isinstance(after, s.Requirement)
    assert pause.where == where and (pause.keep and shape(pause.keep)) == keep


def test_every_place_holds_what_it_names() -> None:
    lines = WHOLE.split("\n")
    names = 0
    pending: list[object] = [read(WHOLE)]
    while pending:
        node = pending.pop()
        if isinstance(node, s.Name):
            text = lines[node.span.line - 1][node.span.column - 1 : node.span.end_column - 1]
            assert text == node.text
            names += 1
        if isinstance(node, msgspec.Struct):
            pending += [getattr(node, name) for name in node.__struct_fields__]
        elif isinstance(node, tuple):
            pending += node
    assert names > 200
