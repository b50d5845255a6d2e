"""Forms of other languages: each gives one error, and its fix writes the form of this language."""

from __future__ import annotations

from typing import Any

import pytest

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.edits import apply_fixes
from skillc_dsl.parsing.foreign import matching
from skillc_dsl.parsing.foreign.form import Form
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

PLACES = {
    "step": "impl x of X {\n    do seq {\n        @\n        Go()\n    }\n}\n",
    "member": "skill X {\n    in a: Arm\n    @\n    noplan\n}\n",
    "value": "impl x of X {\n    @\n    do Go()\n}\n",
    "head": "use skiros\n@\n    do Go()\n}\n",
    "declaration": "use skiros\n@\n",
    "task": 'task t {\n    scene "a.ttl"\n    @\n}\n',
}
PLAIN = (("float", "Number"), ("string", "Text"), ("bool", "Bool"), ("uint8_t", "Int"))
EXAMPLES = (
    ("step", "try { Go() } catch { Turn() }", "sel { seq { Go() } seq { Turn() } }"),
    ("step", "try { Go() } else { Turn() }", "sel { seq { Go() } seq { Turn() } }"),
    ("step", "retry 3 times { Go() }", "retry 3 { Go() }"),
    ("step", "retry { Go() }", "retry 3 { Go() }"),
    ("step", "repeat up to 3 { Go() }", "repeat 3 { Go() }"),
    ("step", "retry 3 Go()", "retry 3 { Go() }"),
    ("step", "loop 3 { Go() }", "repeat 3 { Go() }"),
    ("step", "while (a.x == B) { Go() }", "while (a.x == B) max 10 { Go() }"),
    ("step", "while a.x == B {\n            Go()\n        }", "while a.x == B max 10 {\n            Go()\n        }"),
    ("step", "until a.x == B { Go() }", "while not (a.x == B) max 10 { Go() }"),
    ("step", "for (b in bs) { Go() }", "for b in bs { Go() }"),
    ("step", "foreach b in bs { Go() }", "for b in bs { Go() }"),
    ("step", "for b of bs {\n            Go()\n        }", "for b in bs {\n            Go()\n        }"),
    ("step", "for i in 0..3 { Go() }", "repeat 3 { Go() }"),
    ("step", "if a.x == B { Go() } elif a.x == C { Turn() }", "if a.x == B { Go() } else if a.x == C { Turn() }"),
    ("step", "if a.x == B {\n        } elsif a.x == C {\n            Turn()\n        }", None),
    ("step", "if a.x == B then { Go() }", "if a.x == B { Go() }"),
    ("step", "if a.x == B: Go()", "if a.x == B { Go() }"),
    ("step", "if a.x = B { Go() }", "if a.x == B { Go() }"),
    ("step", "if a.x == B && a.y == C { Go() }", "if a.x == B and a.y == C { Go() }"),
    ("step", "if a.x == B||a.y == C { Go() }", "if a.x == B or a.y == C { Go() }"),
    ("step", "if !(a.x == B) { Go() }", "if not (a.x == B) { Go() }"),
    ("step", "unless a.x == B { Go() }", "if not (a.x == B) { Go() }"),
    ("step", "return", ""),
    ("step", "pass", ""),
    ("step", "assert a.x == B", "check(a.x == B)"),
    ("step", "check a.x == B", "check(a.x == B)"),
    ("step", "m = Weigh(a)", "Weigh(a) -> m"),
    ("step", "var m = Weigh(a)", "Weigh(a) -> m"),
    ("step", "var x = 3", None),
    ("step", "let x = 3", None),
    ("step", "call Go(a)", "Go(a)"),
    ("step", "a.Go()", "Go(a)"),
    ("step", "Go a", "Go(a)"),
    ("step", "Go(a);", "Go(a)"),
    ("step", "Go(a, b = c)", "Go(a, b: c)"),
    ("step", "sleep(1 s)", "wait 1 s"),
    ("step", "wait a.x == B", "wait until a.x == B"),
    ("step", "parallel { Go() Turn() }", "par all { Go() Turn() }"),
    ("step", "par {\n            Go()\n        }", "par all {\n            Go()\n        }"),
    ("step", "sequence { Go() }", "seq { Go() }"),
    ("step", "fallback { Go() Turn() }", "sel { Go() Turn() }"),
    ("step", "not Go()", "invert { Go() }"),
    ("step", "// go", "# go"),
    ("step", "try {\n            Go()\n        } catch {\n            Turn()\n        }", None),
    ("step", "try {\n            Go()\n        } catch (e) {\n            Turn()\n        }", None),
    ("step", "break", None),
    ("step", "switch (a.x) { }", None),
    ("member", "pre a.b(c)", "pre a b c"),
    ("member", "pre a is not Arm", "pre not a is Arm"),
    ("member", "pre a.x is not B", "pre a.x != B"),
    ("member", "pre a is an Arm", "pre a is Arm"),
    ("member", "pre a not hasA b", "pre not a hasA b"),
    ("member", "pre b hasA c or a not hasA b", "pre b hasA c or not a hasA b"),
    ("member", "pre 1 kg < a.m < 5 kg", "pre 1 kg < a.m and a.m < 5 kg"),
    ("member", "pre a.m > 1 kg and < 5 kg", "pre a.m > 1 kg and a.m < 5 kg"),
    ("member", "pre a.m between 1 kg and 2 kg", "pre a.m >= 1 kg and a.m <= 2 kg"),
    ("member", "pre a.x === B", "pre a.x == B"),
    ("member", "pre a.x <> B", "pre a.x != B"),
    ("member", "pre a.x = B", "pre a.x == B"),
    ("member", "pre a.x == B, a.y == C", "pre a.x == B and a.y == C"),
    ("member", "pre a.x == B -> a.y == C", "pre a.x == B implies a.y == C"),
    ("member", "pre if a.x == B then a.y == C", "pre a.x == B implies a.y == C"),
    ("member", "pre exists b in Box: a hasA b", "pre exists b: Box (a hasA b)"),
    ("member", "pre exists b, c: Box (b hasA c)", "pre exists b: Box, c: Box (b hasA c)"),
    ("member", "pre forall b: Box, a hasA b", "pre forall b: Box (a hasA b)"),
    ("member", "pre for all b: Box (a hasA b)", "pre forall b: Box (a hasA b)"),
    ("member", "pre a hasA *", "pre a hasA _"),
    ("member", "pre a hasA b == true", "pre a hasA b"),
    ("member", "post a hasA b = false", "post not a hasA b"),
    ("member", "post delete a hasA b", "post not a hasA b"),
    ("member", "pre a has m == 1 kg", "pre a.m == 1 kg"),
    ("member", "pre exists(a.m)", "pre a has m"),
    ("member", "pre: a hasA b", "pre a hasA b"),
    ("member", "requires a hasA b", "pre a hasA b"),
    ("member", "ensures a hasA b", "post a hasA b"),
    ("member", "param b: Box", "in b: Box"),
    ("member", "in Box b", "in b: Box"),
    ("member", "in b as Box", "in b: Box"),
    ("member", "in b, c: Box", "in b: Box\n    in c: Box"),
    ("member", "opt m: Mass := 1 kg", "opt m: Mass = 1 kg"),
    ("member", "opt m: Mass = 1 kg [1 kg, 2 kg]", "opt m: Mass = 1 kg range 1 kg .. 2 kg"),
    ("member", "in b: List[Pose]", "in b: [Pose]"),
    ("value", "var x = 3 kg", "let x = 3 kg"),
    ("value", "x = 3 kg", "let x = 3 kg"),
    ("value", "let x: Mass = 3 kg", "let x = 3 kg"),
    ("value", "let x := 3 kg", "let x = 3 kg"),
    ("value", "priority 3", "prefer 3"),
    ("head", "impl of X {", None),
    ("head", "impl X {", None),
    ("head", "impl for X {", None),
    ("head", "impl a for X {", "impl a of X {"),
    ("head", "impl a: X {", "impl a of X {"),
    ("head", "impl X.a {", "impl a of X {"),
    ("head", "impl X::a {", "impl a of X {"),
    ("head", "implementation a of X {", "impl a of X {"),
    ("head", "class a implements X {", "impl a of X {"),
    ("declaration", "skill X(a: Arm) {\n    noplan\n}", None),
    ("declaration", "skill X() { noplan }", "skill X { noplan }"),
    ("declaration", "public skill X { noplan }", "skill X { noplan }"),
    ("declaration", "class Blue extends Box", "class Blue < Box"),
    ("declaration", "class Blue: Box", "class Blue < Box"),
    ("declaration", "relation near: Box -> Box", "relation near(Box, Box)"),
    ("declaration", "property p(Box) -> Mass", "property p(Box): Mass"),
    ("declaration", "import motion", 'import "motion.skill"'),
    ("declaration", "from motion import Go", 'import "motion.skill"'),
    ("task", "goal Go(a: lab:A, b: c)", "do Go(a: lab:A, b: c)"),
    ("task", "Go(a: lab:A)", "do Go(a: lab:A)"),
    ("task", "run Go(a: lab:A)", "do Go(a: lab:A)"),
    ("task", "goal: lab:A hasA lab:B", "goal lab:A hasA lab:B"),
    ("task", "goal lab:A hasA lab:B, lab:A hasA lab:C", "goal lab:A hasA lab:B and lab:A hasA lab:C"),
    ("step", "if a.x == B { Go() } otherwise { Turn() }", "if a.x == B { Go() } else { Turn() }"),
    ("step", "try { Go() } finally { Turn() }", None),
    ("step", "repeat { Go() } until a.x == B", None),
    ("step", "loop { Go() }", None),
    ("step", "do { Go() } while a.x == B", None),
    ("step", "when a.x == B { Go() }", "if a.x == B { Go() }"),
    ("step", "seq (Go() Turn())", "seq {Go() Turn()}"),
    ("step", "if a.x == B:\n            Go()", None),
    ("step", "else {\n            Go()\n        }", None),
    ("step", "with Hold() as h { Go() }", "with Hold() { Go() }"),
    ("step", 'throw Error("x")', None),
    ("step", 'raise "too hot"', 'fail "too hot"'),
    ("step", 'fail("too hot")', 'fail "too hot"'),
    ("step", "assert(a.x == B)", "check(a.x == B)"),
    ("step", 'print("x")', ""),
    ("step", "sleep(1)", "wait 1 s"),
    ("step", "wait for 3 s", "wait 3 s"),
    ("step", "wait for a.x == B", "wait until a.x == B"),
    ("step", "wait_until a.x == B", "wait until a.x == B"),
    ("step", "within 3 s { Go() }", "timeout 3 s { Go() }"),
    ("step", "inverter { Go() }", "invert { Go() }"),
    ("step", "do Go()", "Go()"),
    ("step", "begin", None),
    ("step", "a.Go(b)", "Go(a, b)"),
    ("step", "Go", "Go()"),
    ("member", "invariant a hasA b", "hold a hasA b"),
    ("member", "output b: Box", "out b: Box"),
    ("member", "optional m: Mass = 1 kg", "opt m: Mass = 1 kg"),
    ("member", 'description "x"', None),
    ("member", "Box b", "in b: Box"),
    ("member", "opt m: Mass default 1 kg", "opt m: Mass = 1 kg"),
    ("member", "opt m: Mass = 1 kg in 1 kg .. 2 kg", "opt m: Mass = 1 kg range 1 kg .. 2 kg"),
    ("member", 'in b: "Box"', "in b: Box"),
    ("member", "in b: Box[]", "in b: [Box]"),
    ("member", "pre a hasA no b", "pre not a hasA b"),
    ("member", "pre 1 kg < a.m and < 5 kg", "pre 1 kg < a.m and a.m < 5 kg"),
    ("member", "pre a.x in [B, C]", "pre (a.x == B or a.x == C)"),
    ("member", "pre Go(a: b, c: d)", None),
    ("member", "pre has(a, m)", "pre a has m"),
    ("member", "pre a.m exists", "pre a has m"),
    ("member", "pre a->x == B", "pre a.x == B"),
    ("member", "pre a->b(c)", "pre a b c"),
    ("member", "pre there exists b: Box (a hasA b)", "pre exists b: Box (a hasA b)"),
    ("member", "pre {a hasA b}", "pre a hasA b"),
    ("head", "impl a(X) {", "impl a of X {"),
    ("head", "impl X[a] {", "impl a of X {"),
    ("head", "impl a of skill X {", "impl a of X {"),
    ("head", "impl a of X() {", "impl a of X {"),
    ("head", 'impl "a" of X {', "impl a of X {"),
    ("head", "impl a-b of X {", "impl a_b of X {"),
    ("head", "implementation X {", None),
    ("declaration", "skill X extends Y {\n    noplan\n}", None),
    ("declaration", "def X { noplan }", "skill X { noplan }"),
    ("declaration", "def X(a) { noplan }", None),
    ("declaration", "struct Color { Red }", None),
    ("declaration", "namespace lab", None),
    ("declaration", "class Blue < Box { }", "class Blue < Box"),
    ("declaration", "relation near(a: Box, b: Box)", "relation near(Box, Box)"),
    ("declaration", "relation near Box, Box", "relation near(Box, Box)"),
    ("declaration", "property Box.p: Mass", "property p(Box): Mass"),
    ("declaration", 'function f(a: Mass): Mass = python "a:b"', 'function f(a: Mass) -> Mass = python "a:b"'),
    ("declaration", 'include "motion.skill"', 'import "motion.skill"'),
    ("declaration", "prefix lab = <http://a.b/c#>", "prefix lab: <http://a.b/c#>"),
    ("step", "for (int i = 0; i < 3; i++) { Go() }", "repeat 3 { Go() }"),
    ("step", "for (int i = 0; i < 3; i++) {\n            Go()\n        }", "repeat 3 {\n            Go()\n        }"),
    ("step", "for (int i = 1; i <= n; i++) {\n            Go();\n        }", None),
    ("step", "for (auto& b : bs) { Go() }", "for b in bs { Go() }"),
    ("step", "for i in range(3):\n            Go()", None),
    ("step", "try:\n            Go()", None),
    ("step", "for (int i = 0; i < 9; i += 3) { Go() }", None),
    ("step", "if (!Go()) return false;", None),
    ("step", "if a.x == B { return }", None),
    ("step", "do {\n            Go();\n        } while (a.x == B);", None),
    ("step", "Go(a: {b})", "Go(a: b)"),
    ("step", "a.Go();", "Go(a)"),
    ("step", "self.Go()", "Go()"),
    ("step", "this->Go()", "Go()"),
    ("step", "RetryUntilSuccessful(num_attempts=3) { Go() }", "retry 3 { Go() }"),
    ("step", "Repeat(num_cycles=3) { Go() }", "repeat 3 { Go() }"),
    ("step", "Timeout(msec=300) { Go() }", "timeout 300 ms { Go() }"),
    ("step", "Parallel(success_threshold=1) { Go() Turn() }", "par all { Go() Turn() }"),
    ("step", "ForceSuccess { Go() }", "try { Go() }"),
    ("step", "ReactiveSequence { Go() }", "reactive seq { Go() }"),
    ("step", "ReactiveFallback { Go() Turn() }", "reactive sel { Go() Turn() }"),
    ("step", '<Sequence name="x">\n            <Action ID="Go"/>\n        </Sequence>', None),
    ("member", "pre a.m > 1 kg; a.m < 5 kg", "pre a.m > 1 kg and a.m < 5 kg"),
    ("member", "pre a hasA b; b hasA a", "pre a hasA b and b hasA a"),
    ("member", "pre a.m => 1 kg", "pre a.m >= 1 kg"),
    ("member", "pre a hasA b => b hasA a", "pre a hasA b implies b hasA a"),
    ("member", "pre a hasA b <=> b hasA a", None),
    ("member", "pre a hasA b xor b hasA a", None),
    ("member", "pre a.m equals 1 kg", "pre a.m == 1 kg"),
    ("member", "pre a.m is equal to 1 kg", "pre a.m == 1 kg"),
    ("member", "pre a.m greater than 1 kg", "pre a.m > 1 kg"),
    ("member", "pre a.m is less than 1 kg", "pre a.m < 1 kg"),
    ("member", "pre a.m is greater than or equal to 1 kg", "pre a.m >= 1 kg"),
    ("member", "pre a.m at least 1 kg", "pre a.m >= 1 kg"),
    ("member", "pre a.m at most 1 kg", "pre a.m <= 1 kg"),
    ("member", "pre a.m =/= 1 kg", "pre a.m != 1 kg"),
    ("member", "pre a.m ~= 1 kg", "pre a.m != 1 kg"),
    ("member", "pre a.m is not None", "pre a has m"),
    ("member", "pre (and (hasA a b) (hasA b a))", None),
    ("member", "post (increase (total-cost) 1)", None),
    ("member", ":parameters (?a - Arm ?b - Box)", None),
    ("member", ":precondition (and (hasA ?a ?b))", None),
    ("member", ":effect (not (hasA ?a ?b))", None),
    ("member", ":duration (= ?duration 5)", None),
    ("member", "duration (= ?duration 5)", "duration 5 s"),
    ("member", "in ?b - Box", "in b: Box"),
    ("member", "pre at start (a hasA b)", "pre (a hasA b)"),
    ("member", "pre over all (a hasA b)", "hold (a hasA b)"),
    ("member", "const float LIMIT = 5 N", None),
    *(("member", f"in {each} b", f"in b: {kind}") for each, kind in PLAIN),
    *(("member", f"{each} b", f"in b: {kind}") for each, kind in PLAIN),
    ("declaration", "(:action go\n  :parameters (?a - Arm ?b - Box)\n  :effect (hasA ?a ?b))", None),
    ("declaration", "(define (domain lab)\n  (:requirements :strips)\n)", None),
    ("declaration", "(:goal (hasA ?a ?b))", None),
    ("declaration", "class Tidy(Skill):\n    def execute(self):\n        pass", None),
    ("task", "goals lab:A hasA lab:B", "goal lab:A hasA lab:B"),
    ("task", "steps { Go() }", "do seq { Go() }"),
    ("task", "robot lab:A", None),
    ("task", "scene b.ttl", None),
)  # fmt: skip


@pytest.mark.parametrize(("place", "written", "meant"), EXAMPLES, ids=[each[1].split("\n")[0] for each in EXAMPLES])
def test_form(place: str, written: str, meant: str | None) -> None:
    text = PLACES[place].replace("@", written)
    [problem] = parse(Source("own.skill", text)).diagnostics
    assert problem.help or problem.fix
    if meant is None:
        return
    assert problem.fix is not None
    fixed = apply_fixes(text, [problem.fix])
    assert fixed.replace("{  ", "{ ") == PLACES[place].replace("@", meant)
    again = parse(Source("own.skill", fixed)).diagnostics
    assert again == ()


def test_each_form_has_an_example(monkeypatch: pytest.MonkeyPatch) -> None:
    found = set[Form]()

    def report(form: Form, *place: Any) -> Diagnostic:
        found.add(form)
        return make(form, *place)

    make = matching._problem
    monkeypatch.setattr(matching, "_problem", report)
    for place, written, _ in EXAMPLES:
        parse(Source("own.skill", PLACES[place].replace("@", written)))
    assert [form.pattern for form in matching.FORMS if form not in found] == []


def test_a_part_of_a_product_is_not_repeated_alone() -> None:
    text = PLACES["member"].replace("@", "pre 2 * a.m >= 1 kg and <= 2 kg")
    [problem] = parse(Source("own.skill", text)).diagnostics
    assert "a.m" not in problem.help
    assert problem.fix is None or "a.m" not in problem.fix.text


def test_a_form_with_a_fix_does_not_hide_what_else_is_wrong_in_its_line() -> None:
    text = PLACES["member"].replace("@", "pre a.m => 1 kg and a.n > 5 furlong")
    assert [each.name for each in parse(Source("own.skill", text)).diagnostics] == ["syntax", "unknown-unit"]


def test_a_form_that_is_not_reported_hides_nothing() -> None:
    text = PLACES["member"].replace("@", "pre skill a.m 1 kg; a.m < 5 kg")
    found = parse(Source("own.skill", text)).diagnostics
    assert "unknown-character" in [each.name for each in found]
