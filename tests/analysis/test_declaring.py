"""What `undeclared-effect` offers is accepted once it is added, with nothing else to say."""

from __future__ import annotations

from pathlib import Path

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.edits import apply_fixes
from skillc_dsl.source import Source

MANY = """
skill FillThose { in part: Part  in full: Energy  post forall a: Arm (a.charge := full when a holds part)  noplan }
skill DrainThose { in part: Part  post forall a: Arm (a.charge -= 1 Wh when a holds part)  noplan }
skill Find { in place: Place  infer part: Part  pre part at place  pre part.isWet == false  post part.isWet == true }
"""
THINGS = Source("things.skill", (Path(__file__).parent / "pairs/things.skill").read_text() + MANY)
CASES = {
    "in place: Place": [
        "for p: Part where p at place { try { Soil(part: p) } }",
        "for p: Part where p at place { for q: Part where not q == p { Join(one: p, other: q) } }",
        "for p: Part where p at place { for q: Place { Move(part: p, to: q) } }",
        "for p: Part where p at place { Soil(part: p) }",
        "for p: Part where p at place { if p.isWet == true { Soil(part: p) } }",
        "for p: Part where p at place { Wash(part: p)  Soil(part: p) }",
        "seq { for p: Part where p at place { Soil(part: p) }  for q: Part where q at place { Wash(part: q) } }",
        "for p: Part where p at place and not p is Cup { retry 3 { Soil(part: p) } }",
    ],
    "in place: Place  in machine: Machine": [
        "if machine.isHot == true { for p: Part where p at place { Soil(part: p) } }",
        "for p: Part where p at place { Dry(part: p)  Heat(machine) }",
    ],
    "in place: Place  in machine: Machine  pre machine.isOn == false": [
        "Pick(place)",
        "seq { Heat(machine)  Pick(place) }",
        "if machine.isHot == true { Pick(place) } else { Pick(place) }",
        "seq { Heat(machine)  repeat 3 { Pick(place) } }",
        "seq { Heat(machine)  for a: Arm where not a holds _ { Pick(place) } }",
        "if machine.isHot == true { Pick(place) } else { wait 1 s }",
        "sel { Pick(place)  Heat(machine) }",
    ],
    "in shelf: Shelf": ["for t: Tray where t rests shelf { Shake(tray: t) }"],
    "in place: Place  in part: Part": [
        "seq { Wash(part)  Rinse(place)  Soil(part) }",
        "seq { Move(part, to: place)  Rinse(place) }",
    ],
    "in arm: Arm  in place: Place  in to: Place  pre not place == to  pre not arm holds _": [
        "for p: Part where p at place { Take(arm, part: p)  Put(arm, part: p, to) }",
    ],
    "in machine: Machine  in part: Part": ["if machine.isHot == true { Soil(part) } else { Wash(part) }"],
    "in arm: Arm  in one: Place  in other: Place": [
        "seq { Go(arm, to: one)  Go(arm, to: other) }",
        "seq { repeat 3 { Drain(arm) }  try { Strain(arm) }  Go(arm, to: one)  Go(arm, to: other) }",
        "seq { Drain(arm)  Charge(arm)  Go(arm, to: one)  Go(arm, to: other) }",
        "while one == other max 5 { Drain(arm) }",
        "for a: Arm where not a == arm { for p in [one, other] { Go(arm: a, to: p) } }",
    ],
    "in part: Part  in full: Energy": ["FillThose(part, full)"],
    "in machine: Machine  in part: Part  in door: Door": [
        "seq { Heat(machine)  Open(door) } on failure { Soil(part) }",
        "seq { Heat(machine)  Wash(part) } finally { Open(door) }",
        "seq { try { Wash(part) }  Open(door)  if door.isLocked == true { Cool(machine) } }",
    ],
    "in part: Part": ["FillThose(part, full: 20 Wh)", "DrainThose(part)", "seq { DrainThose(part)  DrainThose(part) }"],
    "in arm: Arm  in several: [Place]": ["for place in several { Go(arm, to: place) }"],
    "": ["for p: Part { Dry(part: p) }", "seq { Choose() -> found  Soil(part: found) }"],
}


BARE = 'import "things.skill"\nskill Own {{ in {}  noplan }}\nimpl own of Own {{ do {} }}\n'


def told(text: str, edition: int = 2) -> list[Diagnostic]:
    sources = [THINGS, Source("own.skill", text, edition=edition)]
    found = compile(sources, vocabulary(), shelf(), "pairs").diagnostics
    return [each for each in found if each.span.path == "own.skill"]


@pytest.mark.parametrize(("head", "body"), [(head, body) for head, bodies in CASES.items() for body in bodies])
def test_what_is_offered_is_accepted(head: str, body: str) -> None:
    text = f'import "things.skill"\nskill Own {{ {head}  noplan }}\nimpl own of Own {{ do {body} }}\n'
    [problem] = told(text)
    assert (problem.name, problem.fix is not None) == ("undeclared-effect", True), problem
    assert problem.fix is not None
    assert [(each.name, each.message) for each in told(apply_fixes(text, [problem.fix]))] == []


def test_a_change_of_many_counts_each_time() -> None:
    own = "skill Own { in part: Part  post forall a: Arm (a.charge -= 1 Wh when a holds part)  noplan }"
    body = "seq { DrainThose(part)  DrainThose(part) }"
    (problem,) = told(f'import "things.skill"\n{own}\nimpl own of Own {{ do {body} }}\n')
    assert problem.name == "post-not-established"


def test_a_precondition_that_is_taken_over_is_not_offered_again() -> None:
    own = "skill Own { in place: Place  in other: Place  pre of Find(place)  noplan }"
    (problem,) = told(f'import "things.skill"\n{own}\nimpl own of Own {{ do Find(place: other) }}\n')
    assert problem.help.startswith("add `pre part at other` and `post part.isWet == true` to `Own`")


def test_numbers_have_the_units_of_the_text() -> None:
    (problem,) = told('import "things.skill"\nskill Own { in arm: Arm  noplan }\nimpl own of Own { do Drain(arm) }\n')
    assert problem.help.startswith("add `post arm.charge -= 1 Wh` to `Own`")


def test_what_is_possible_of_a_call_is_said_again() -> None:
    maybe = "skill May { in part: Part  post possible part.isWet == true and part.isClean == true  noplan }\n"
    maybe += "impl may of May { do try { Wash(part) } }\n"
    (problem,) = told(maybe + BARE.format("part: Part", "May(part)"))
    assert problem.help == (
        "add `post possible part.isWet == true` and `post possible part.isClean == true` to `Own`, or undo it"
    )
    assert told(maybe + BARE.format("part: Part", "seq { May(part)  Dry(part)  Soil(part) }")) != []


def test_a_later_edition_has_the_words() -> None:
    (problem,) = told(BARE.format("part: Part", "try { Soil(part) }"), edition=1)
    assert problem.help == "undo it, or let every success have it, or none: no `post` says what only some have"
