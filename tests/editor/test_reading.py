"""Hover, definitions, references, outlines, colours, folds and signatures."""

from __future__ import annotations

from urllib.parse import unquote

import pytest
from lsprotocol import types

from editor.desk import Desk
from editor.texts import MOTION, PRESS, marked, replaced, with_line

pytestmark = pytest.mark.asyncio(loop_scope="session")

HOVERS = [
    ("Move(arm", 1, ("skill Move", "in target: Pose", "Move the tool to `target`.", "implementations: `line`")),
    ("isClean", 2, ("property isClean(", "): Bool", "`wiping:isClean`")),
    ("fixedTo at", 2, ("relation fixedTo(Panel, Location)", "functional")),
    ("deviceState", 2, ("one of `Idle`, `Busy`, `Fault`",)),
    ("10 N", 1, ("**Force** `10 N`",)),
    ("5 cm", 1, ("**Length** `5 cm` = `0.05 m`",)),
    ("CompliantArm", 3, ("class CompliantArm < ", "`skillc:CompliantArm`")),
    ("Force = 10", 2, ("the type **Force**, in `N`",)),
    ("along: panel.normal", 1, ("in along: Direction", "parameter of `Compliance`")),
    ("panel.normal)", 8, ("property normal(", "): Direction")),
    (
        "lifted(panel",
        2,
        ("function lifted(pose: Pose, by: Length) -> Pose", "skillc_runtime.world.places:raised"),
    ),
    ("above)", 2, ("let above = lifted(panel.pose, 5 cm)", "a Pose")),
    ("done\n", 2, ("post  done:  panel.isClean == true",)),
    ("Fault", 2, ("a value of `deviceState`",)),
    ("slowly", 2, ("impl slowly of Press",)),
    ("Move(arm", 2, ("skill Move", "pause anywhere keep 250 ms")),
    ("target: above", 2, ("in target: Pose", "parameter of `Move`")),
    ("seq {", 1, ("seq { .. }", "runs its children in order until one fails")),
    ("post  done", 1, ("post", "a postcondition: true afterwards")),
    ("infer at", 3, ("infer NAME: CLASS", "the world model, through the preconditions")),
]
DEFINITIONS = [
    ("Move(arm", "motion.skill", 3),
    ("CompliantArm", "vocabulary/skillc.ttl", None),
    ("fixedTo at", "press.skill", 5),
    ("Panel\n    in    arm", "press.skill", 4),
    ("above)", "press.skill", None),
    ('"compliance.skill"', "std/compliance.skill", 0),
    ("target: above", "motion.skill", 5),
    ("done\n", "press.skill", None),
]


@pytest.mark.parametrize(("words", "at", "told"), HOVERS, ids=[words for words, _, _ in HOVERS])
async def test_hover_tells_what_a_name_is(desk: Desk, words: str, at: int, told: tuple[str, ...]) -> None:
    desk.library(motion=MOTION)
    hover = await desk.client.text_document_hover_async(
        types.HoverParams(*desk.at("press.skill", marked(PRESS, words, at)))
    )
    assert hover is not None
    assert isinstance(hover.contents, types.MarkupContent)
    assert all(part in hover.contents.value for part in told), hover.contents.value


async def test_a_shorthand_argument_tells_of_both(desk: Desk) -> None:
    desk.library(motion=MOTION)
    text = marked(PRESS, "Move(arm", 6)
    hover = await desk.client.text_document_hover_async(types.HoverParams(*desk.at("press.skill", text)))
    assert hover is not None
    assert isinstance(hover.contents, types.MarkupContent)
    assert "parameter of `Move`" in hover.contents.value
    assert "parameter of `Press`" in hover.contents.value


async def test_the_inverse_of_a_relation_is_told(desk: Desk) -> None:
    text = with_line(PRESS, "pre   fixed", "    pre   at con|tain panel")
    hover = await desk.client.text_document_hover_async(types.HoverParams(*desk.at("press.skill", text)))
    assert hover is not None
    assert isinstance(hover.contents, types.MarkupContent)
    assert "inverse of `containedIn`" in hover.contents.value


@pytest.mark.parametrize("text", ["use skiros\n|", "# no|thing\n", "", "|", "skill {|"])
async def test_nothing_is_told_where_there_is_nothing(desk: Desk, text: str) -> None:
    at = desk.at("empty.skill", text)
    assert await desk.client.text_document_hover_async(types.HoverParams(*at)) is None
    assert not await desk.client.text_document_definition_async(types.DefinitionParams(*at))
    assert await desk.client.text_document_signature_help_async(types.SignatureHelpParams(*at)) is None


@pytest.mark.parametrize(("words", "file", "line"), DEFINITIONS, ids=[words for words, _, _ in DEFINITIONS])
async def test_definitions_are_found_in_skills_and_in_turtle(
    desk: Desk, words: str, file: str, line: int | None
) -> None:
    desk.library(motion=MOTION)
    params = types.DefinitionParams(*desk.at("press.skill", marked(PRESS, words, 1)))
    found = await desk.client.text_document_definition_async(params)
    assert isinstance(found, list)
    (place,) = found
    assert isinstance(place, types.Location)
    assert unquote(place.uri).endswith(f"/{file}")
    assert line is None or place.range.start.line == line


async def test_references_are_found_in_all_files(desk: Desk) -> None:
    desk.library(motion=MOTION)
    document, position = desk.at("press.skill", marked(PRESS, "Move(arm", 1))
    found = {}
    for declarations in (True, False):
        context = types.ReferenceContext(include_declaration=declarations)
        params = types.ReferenceParams(context, document, position)
        places = await desk.client.text_document_references_async(params)
        assert places is not None
        found[declarations] = [(unquote(place.uri).rpartition("/")[2], place.range.start.line) for place in places]
    assert found[True] == [("motion.skill", 3), ("motion.skill", 13), ("press.skill", 26)]
    assert found[False] == found[True][1:]


async def test_implementations_of_a_skill_are_found(desk: Desk) -> None:
    desk.library(motion=MOTION)
    params = types.ImplementationParams(*desk.at("press.skill", marked(PRESS, "Move(arm", 1)))
    found = await desk.client.text_document_implementation_async(params)
    assert isinstance(found, list)
    assert [place.uri for place in found if isinstance(place, types.Location)] == [desk.uri("motion.skill")]


async def test_the_same_name_is_marked_in_the_file(desk: Desk) -> None:
    desk.library(motion=MOTION)
    params = types.DocumentHighlightParams(*desk.at("press.skill", marked(PRESS, "panel.normal", 1)))
    found = await desk.client.text_document_document_highlight_async(params)
    assert found is not None
    assert len(found) == PRESS.count("panel") - 1  # the documentation speaks of it too


async def test_the_outline_shows_declarations_with_their_members(desk: Desk) -> None:
    desk.open("press.skill", PRESS)
    params = types.DocumentSymbolParams(types.TextDocumentIdentifier(desk.uri("press.skill")))
    found = await desk.client.text_document_document_symbol_async(params)
    assert found is not None
    names = [symbol.name for symbol in found]
    assert names == ["Panel", "fixedTo", "wear", "lifted", "Press", "slowly"]
    press = found[4]
    assert isinstance(press, types.DocumentSymbol)
    children = [(child.name, child.detail) for child in press.children or ()]
    assert children[:4] == [("panel", "in"), ("arm", "in"), ("push", "opt"), ("at", "infer")]
    assert children[4:] == [("fixed", "pre"), ("ready", "hold"), ("done", "post")]


async def test_a_broken_file_still_has_an_outline(desk: Desk) -> None:
    desk.open("press.skill", replaced(PRESS, "pre   fixed: panel fixedTo at", "pre   fixed: panel"))
    params = types.DocumentSymbolParams(types.TextDocumentIdentifier(desk.uri("press.skill")))
    found = await desk.client.text_document_document_symbol_async(params)
    assert [symbol.name for symbol in found or ()][-2:] == ["Press", "slowly"]


async def test_names_are_found_in_all_libraries_at_hand(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    found = await desk.client.workspace_symbol_async(types.WorkspaceSymbolParams("prs"))
    here = [symbol.name for symbol in found or () if desk.folder.name in symbol.location.uri]
    assert here == ["Press"]
    assert not await desk.client.workspace_symbol_async(types.WorkspaceSymbolParams("nobody calls anything so"))


async def test_words_are_coloured_by_what_they_stand_for(desk: Desk) -> None:
    desk.library(motion=MOTION)
    desk.open("press.skill", PRESS)
    words = await coloured(desk, "press.skill", PRESS)
    assert {("Panel", "class"), ("fixedTo", "method"), ("isClean", "property"), ("Force", "type")} <= words
    assert {("Move", "function"), ("push", "parameter"), ("above", "variable"), ("Fault", "enumMember")} <= words
    assert {("10 N", "number"), ("skill", "keyword"), ("skiros", "namespace"), ("done", "decorator")} <= words
    assert ("# Press", "comment") not in words
    assert ("at", "parameter") in words


async def test_an_empty_file_has_no_colours(desk: Desk) -> None:
    desk.open("empty.skill", "")
    assert not await coloured(desk, "empty.skill", "")


async def test_blocks_headers_and_comments_fold(desk: Desk) -> None:
    text = f"# one\n# two\n{PRESS}"
    desk.open("press.skill", text)
    params = types.FoldingRangeParams(types.TextDocumentIdentifier(desk.uri("press.skill")))
    found = await desk.client.text_document_folding_range_async(params)
    kinds = [(fold.start_line, fold.end_line, fold.kind) for fold in found or ()]
    assert kinds[:2] == [(0, 1, "comment"), (2, 4, "imports")]
    lines = text.split("\n")
    assert all(lines[first].endswith("{") for first, _, kind in kinds if kind == "region")
    assert len(kinds) == 2 + 4


@pytest.mark.parametrize(
    ("line", "head", "active"),
    [
        ("        Move(|", "Move(in arm: ArmDevice", 0),
        ("        Move(arm, |", "Move(", 1),
        ("        Move(arm, speed: 3|", "Move(", 2),
        ("        Move(arm, target: lifted(|", "lifted(pose: Pose, by: Length) -> Pose", 0),
        ("        Move(arm, target: lifted(panel.pose, |", "lifted(", 1),
        ("        Move(arm, target: lifted(panel.pose, 1 cm), |", "Move(", 2),
    ],
)
async def test_a_call_shows_its_signature(desk: Desk, line: str, head: str, active: int) -> None:
    desk.library(motion=MOTION)
    text = with_line(PRESS, "do seq {", line)
    params = types.SignatureHelpParams(*desk.at("press.skill", text))
    found = await desk.client.text_document_signature_help_async(params)
    assert found is not None
    assert found.signatures[0].label.startswith(head)
    assert found.active_parameter == active


async def coloured(desk: Desk, name: str, text: str) -> set[tuple[str, str]]:
    """Return the words of a file with their kinds."""
    capabilities = desk.client.initialize_result.capabilities  # type: ignore[attr-defined]
    kinds = capabilities.semantic_tokens_provider.legend.token_types
    params = types.SemanticTokensParams(types.TextDocumentIdentifier(desk.uri(name)))
    found = await desk.client.text_document_semantic_tokens_full_async(params)
    assert found is not None
    words, line, start = set(), 0, 0
    lines = text.split("\n")
    for index in range(0, len(found.data), 5):
        down, right, width, kind, _ = found.data[index : index + 5]
        line, start = line + down, right if down else start + right
        words.add((lines[line][start : start + width], kinds[kind]))
    return words
