"""The forms of edition 2 in the editor: hover, references, colours and completion of each."""

from __future__ import annotations

import pytest
from lsprotocol import types

from editor.desk import Desk
from editor.grades import GRADES
from editor.test_reading import coloured
from editor.texts import marked, with_line

pytestmark = pytest.mark.asyncio(loop_scope="session")

HOVERS = [
    ("enum ", 1, "a class with these individuals and no others"),
    ("Good, Bad", 1, "`Good`: a value of `Mood`: Good, Bad"),
    ("Grade = Good", 9, "`Good`: a value of `Grade`: Good, Rework"),
    ("standsIn", 1, "`x standsIn l` is defined as `l contain x or"),
    ("senses", 1, "the skill makes this property known"),
    ("good:", 1, "outcome good:"),
    ("likely", 1, "what can come of the skill"),
    ("sensed", 1, "a postcondition: true afterwards"),
    ("failure as", 1, "runs the second block when the first one has failed"),
    ("why.kind", 1, "`why`: the failure"),
    ("part} stays", 1, "in part: Product"),
    ("why}", 1, "`why`: the failure"),
    ("kind ==", 1, "what kind of failure it is"),
    ("skill} of", 1, "the innermost skill that failed"),
    ("why.skill}", 1, "`why`: the failure"),
    ("load(Product)", 1, "in the range 0 kg .. 5 kg"),
    ("grade}", 1, "relation grade(Product, Grade)"),
    ("finally", 1, "runs the second block once the first one has succeeded or failed"),
    ("outside", 1, "unless the skill after it is active"),
    ("test a_part", 1, "says what comes of a body or a goal"),
    ("-> good", 4, "outcome good:"),
    ("expect", 1, "what holds at the end"),
    ("count(", 1, "how many individuals of the class there are"),
    ("where cup", 1, "for each individual"),
    ("by count", 1, "for each individual"),
    ("cup.isOpen", 1, "`cup`: the loop variable, a Cup"),
    ("skill Judge", 1, "what can be done"),
    ("not part.grade", 1, "the condition after it does not hold"),
]
OFFERS = [
    ("opt   want", "    post  part.load -= |", "part.load sum", "part.grade good"),
    ("impl by_judging", "    out   |", "seen", "part"),
    ("impl by_judging", "    out   seen = |", "count sum", "part Good"),
    ("Judge(part)", '        fail "no {|', "part arm", "why cup c"),
    ("Judge(part)", '        for cup: Cup where cup.isOpen == true { Note(text: "{|', "part arm cup", "why c"),
    ("TakePosture(arm)", '        Note(text: "{|', "part arm", "why cup c"),
    ("TakePosture(arm)", "        if exists x: Cup (x.isOpen == true) and |", "part arm", "x why cup"),
    ("opt   want", "    senses |", "part station want", "offset true"),
    ("opt   want", "    opt more: Grade = |", "Good Rework", "want offset Bad"),
    ("opt   want", "    pre   part.grade == |", "Good Rework want", "Bad"),
    ("outcome rework", "    outcome |", "", "part good"),
    ("opt   want", "    pre exists c: Cup, d: |", "Cup Location", "part"),
    ("opt   want", "    pre exists c: Cup, d: Location (|", "c d part", "Cup"),
    ("opt   want", "    post |", "some forall", "Cup"),
    ("opt   want", "    pre of |", "Judge Approve", "Cup part"),
    ("opt   want", "    pre of Approve(|", "arm: part", "Cup"),
    ("opt   want", "    post some c: |", "Cup Location", "part"),
    ("opt   want", "    post some c: Cup (c.isOpen == false where |", "c part", "Cup"),
    ("on failure as", "        if why.|", "kind message skill source", "grade"),
    ("on failure as", '        fail "no {{ {|', "part arm why", "grade Good"),
    ("on failure as", '        fail "no {{ {why.|', "kind message skill source", "part grade"),
    ("on failure as", '        Note(text: "no {why.me|', "kind message skill source", "why"),
    ("on failure as", '        fail "no {part.|', "grade", "kind part isOpen"),
    ("on failure as", '        Note(text: "no {p|', "part arm why", "grade Good"),
    ("on failure as", '        TakePosture(arm, posture: "no {p|', "", "part"),
    ("wait 1 s", "        seq { wait 1 s } |", "finally on", "else"),
    ("scene ", "    |", "always start expect", "within minimise"),
    ("scene ", "    start |", "Judge lab:Eraser-1", "Approve"),
    ("scene ", "    start Judge -> |", "good rework", "here"),
    ("scene ", "    expect no |", "plan", "contain grade"),
    ("isOpen", "task go { backend |", "kinematic mujoco symbolic", "Judge contain"),
    ("isOpen", "task go {\n    |", "scene goal always within minimise", "Judge contain"),
    ("isOpen", "task go {\n    always |", "forall exists not", "scene"),
    ("isOpen", "task go { minimise |", "makespan work cost", "Judge scene"),
    ("TakePosture(arm)", "    }\n    verify never |", "Judge Approve TakePosture", "seq"),
    ("Judge(part)", "        wait count(c: |", "Cup Location", "part"),
    ("Judge(part)", "        wait count(c: Cup where c.|", "isOpen", "part"),
    ("Judge(part)", "        for c: |", "Cup Location", "part"),
    ("Judge(part)", "        for c: Cup |", "where by", "max"),
    ("Judge(part)", "        for c: Cup where c.|", "isOpen", "part"),
    ("Judge(part)", "        repeat |", "count sum", "part"),
    ("isOpen", "task go(x: |", "Grade Cup Length", "Judge"),
]


@pytest.mark.parametrize(("words", "at", "told"), HOVERS, ids=[words for words, _, _ in HOVERS])
async def test_hover_tells_what_each_form_means(desk: Desk, words: str, at: int, told: str) -> None:
    desk.project()
    place = types.HoverParams(*desk.at("grades.skill", marked(GRADES, words, at)))
    hover = await desk.client.text_document_hover_async(place)
    assert hover is not None and isinstance(hover.contents, types.MarkupContent)
    assert told in hover.contents.value


@pytest.mark.parametrize(("after", "line", "offered", "absent"), OFFERS, ids=[line.strip() for _, line, _, _ in OFFERS])
async def test_what_fits_is_among_the_offers(desk: Desk, after: str, line: str, offered: str, absent: str) -> None:
    desk.project()
    found = set(await desk.completions("grades.skill", with_line(GRADES, after, line)))
    assert set(offered.split()) <= found
    assert not found & set(absent.split())


async def test_values_of_the_same_name_are_told_apart(desk: Desk) -> None:
    desk.project()
    document, position = desk.at("grades.skill", marked(GRADES, "Good, Rework", 1))
    context = types.ReferenceContext(include_declaration=True)
    found = await desk.client.text_document_references_async(types.ReferenceParams(context, document, position))
    lines = GRADES.split("\n")
    assert [lines[place.range.start.line].split()[0] for place in found or ()] == [
        *("enum", "opt", "outcome", "post", "if", "expect")
    ]


async def test_a_value_leads_to_its_enumeration(desk: Desk) -> None:
    desk.project()
    params = types.DefinitionParams(*desk.at("grades.skill", marked(GRADES, "grade == Good\n", 10)))
    (place,) = await desk.client.text_document_definition_async(params) or ()
    assert isinstance(place, types.Location)
    assert GRADES.split("\n")[place.range.start.line].startswith("enum     Grade")


async def test_words_that_came_later_are_no_keywords_in_an_older_edition(desk: Desk) -> None:
    skill = "use rparts\n\nskill Wait {\n    in  arm: ArmDevice\n    pre arm senses arm\n}\n"
    text = f'{skill}\ntest go {{\n    scene "x.ttl"\n'
    desk.project(edition=1)
    desk.open("old.skill", text)
    words = await coloured(desk, "old.skill", text)
    assert ("senses", "variable") in words
    assert {("skill", "keyword"), ("test", "keyword")} <= words
    offered = await desk.completions("old.skill", text.replace("    pre arm senses arm", "    |"))
    assert "pre" in offered and not {"senses", "outcome"} & set(offered)
