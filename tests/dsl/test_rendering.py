"""Diagnostics as people and machines read them."""

import json as standard_json
import re

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.rendering import concise, full, json
from skillc_dsl.source import Source, Span

SOURCE = Source("a.skill", "skill Pick {\n\tin arm:Arm\n}\n")
PROBLEM = Diagnostic(
    "missing-space-after-colon",
    Span("a.skill", 2, 5, 2, 9),
    "a space is missing",
    "type one",
    labels=(Label(Span("a.skill", 1, 7, 1, 11), "in this skill"), Label(Span("robot.ttl", 12, 1, 12, 4), "the class")),
    fix=Fix(Span("a.skill", 2, 9, 2, 9), " ", "insert a space"),
)

EXPECTED = """\
error[missing-space-after-colon]: a space is missing
  --> a.skill:2:5
   |
 1 | skill Pick {
   |       ---- in this skill
 2 |     in arm:Arm
   |        ^^^^
  ::: robot.ttl:12:1: the class
   = help: type one
   = fix: insert a space (--fix does it)
 + |     in arm: Arm
"""


def test_full() -> None:
    assert full.render([PROBLEM], {"a.skill": SOURCE}) == EXPECTED


def test_colour_adds_nothing_but_colour() -> None:
    coloured = full.render([PROBLEM], {"a.skill": SOURCE}, colour=True)
    assert "\x1b[1;31m" in coloured
    assert re.sub(r"\x1b\[[\d;]*m", "", coloured) == EXPECTED


def test_a_span_of_several_lines_is_marked_on_its_first() -> None:
    long = Diagnostic("long", Span("a.skill", 1, 7, 3, 2), "all of it", severity="warning")
    assert full.render([long], {"a.skill": SOURCE}).splitlines()[3:] == ["1 | skill Pick {", "  |       ^^^^^^"]


def test_concise() -> None:
    assert concise.render([PROBLEM], {}) == "a.skill:2:5: error[missing-space-after-colon]: a space is missing\n"


def test_json() -> None:
    place = {"path": "a.skill", "line": 2, "column": 5, "end_line": 2, "end_column": 9}
    name = {"path": "a.skill", "line": 1, "column": 7, "end_line": 1, "end_column": 11}
    term = {"path": "robot.ttl", "line": 12, "column": 1, "end_line": 12, "end_column": 4}
    gap = {"path": "a.skill", "line": 2, "column": 9, "end_line": 2, "end_column": 9}
    assert standard_json.loads(json.render([PROBLEM], {})) == [
        {
            "name": "missing-space-after-colon",
            "severity": "error",
            **place,
            "message": "a space is missing",
            "help": "type one",
            "labels": [{**name, "message": "in this skill"}, {**term, "message": "the class"}],
            "fix": {**gap, "text": " ", "message": "insert a space", "safe": True},
        }
    ]


def test_nothing_to_say() -> None:
    assert (full.render([], {}), concise.render([], {}), json.render([], {})) == ("", "", "[]\n")


HOSTILE = Diagnostic("odd", Span("a\x1b.skill", 1, 3, 1, 4), "`\x1b[31m`", "not \x9b\x00", fix=None)


def test_control_characters_are_never_printed() -> None:
    hostile = {"a\x1b.skill": Source("a\x1b.skill", "ab\x1b[2J\x07\u202e\n")}
    for text in (full.render([HOSTILE], hostile), concise.render([HOSTILE], hostile), json.render([HOSTILE], hostile)):
        assert not re.search("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e]", text)
    assert standard_json.loads(json.render([HOSTILE], hostile))[0]["message"] == "`\x1b[31m`"


def test_a_long_line_is_shown_around_its_place() -> None:
    source = Source("a.skill", "x" * 5000 + "here" + "y" * 5000)
    excerpt, carets = full.render(
        [Diagnostic("far", Span("a.skill", 1, 5001, 1, 5005), "")], {"a.skill": source}
    ).splitlines()[-2:]
    assert len(excerpt) < 200
    assert excerpt[carets.index("^") : carets.rindex("^") + 1] == "here"
