"""Names in all texts of a project: renamed, found and followed between skills, Turtle and the manifest."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from lsprotocol import types
from pygls.exceptions import JsonRpcException

from editor.desk import Desk
from editor.texts import marked

pytestmark = pytest.mark.asyncio(loop_scope="session")

MANIFEST = """name = "yard"
edition = 2
namespace = "http://example.org/yard#"
scene = "cell.ttl"

[tasks.tidy]   # lab:Crate-7 goes first
goal = "lab:Crate-7 stackedOn lab:Crate-8 and lab:Crate-7.mood == calm"

[tasks]
sort = { goal = '''
lab:Crate-7 yard:stackedOn lab:Crate-8''' }

[tool.run]
backend = "symbolic"
"""
SKILL = """use skiros, extra
prefix lab: <http://example.org/lab#>
prefix own: <http://example.org/yard#>

class Crate < Product
enum Mood { calm, wild }
relation stackedOn(Crate, Crate)
property mood(Crate): Mood
property filling(Crate): Number

skill Stack {
    in  crate: Crate
    in  onto:  Crate
    pre crate.mood == calm and crate.weightClass == 1
    post crate stackedOn onto
}

skill Clear {
    in    crate: Crate
    infer under: Crate
    pre  crate stackedOn under
    post not crate stackedOn under
}

skill Restack {
    in  crate: Crate
    in  onto:  Crate
    pre of Clear(crate)
    pre not under == onto
    post crate stackedOn onto
}

skill Free {
    in   base: Crate
    post some top: Crate (not top stackedOn base where top stackedOn base)
}

task go {
    goal lab:Crate-7 own:stackedOn lab:Crate-8 and lab:Crate-7.mood == own:Mood-calm
}
"""
SCENE = """@prefix lab: <http://example.org/lab#> . @prefix o: <http://example.org/yard#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix x: <http://example.org/extra#> .

lab:Crate-7   a o:Crate ;    # Crate-7, a Crate
    o:mood o:Mood-calm ; o:filling 0.5 ;
\to:stackedOn <http://example.org/lab#Crate-8> ;x:weightClass 1 .
lab:Crate-8 a o:Crate ; o:mood o:Mood-wild ; o:filling 1.0.
"""
GRAPHS = """# Crate-7 in another file
PREFIX lab: <http://example.org/lab#>
lab:g {lab:Crate-7 <http://example.org/yard#stackedOn> lab:Crate-8}
"""
WORDS = """@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix extra: <http://example.org/extra#> .

<http://example.org/extra> a owl:Ontology .
extra:weightClass a owl:DatatypeProperty ; rdfs:domain skiros:Product ; rdfs:range xsd:integer . # weightClass
"""
FILES = {"skillc.toml": MANIFEST, "a.skill": SKILL, "cell.ttl": SCENE, "far.trig": GRAPHS, "words.ttl": WORDS}


def write(desk: Desk) -> None:
    for name, text in FILES.items():
        (desk.folder / name).write_text(text, "utf-8")


def replaced(name: str, *pairs: tuple[str, str]) -> str:
    """Return a file's text with pieces replaced, each of which is in it."""
    text = FILES[name]
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


RENAMES = [
    (
        "an individual",
        ("a.skill", "lab:Crate-7 own", 5),
        "Box_7",
        {
            "a.skill": replaced("a.skill", ("lab:Crate-7", "lab:Box_7")),
            "cell.ttl": replaced("cell.ttl", ("lab:Crate-7", "lab:Box_7")),
            "far.trig": replaced("far.trig", ("lab:Crate-7", "lab:Box_7")),
            "skillc.toml": replaced(
                "skillc.toml",
                ('"lab:Crate-7 ', '"lab:Box_7 '),
                ("and lab:Crate-7", "and lab:Box_7"),
                ("\nlab:Crate-7", "\nlab:Box_7"),
            ),
        },
    ),
    (
        "a class, in Turtle",
        ("cell.ttl", "o:Crate ;", 4),
        "Box",
        {
            "a.skill": replaced(
                "a.skill",
                ("class Crate", "class Box"),
                ("(Crate, Crate)", "(Box, Box)"),
                ("(Crate)", "(Box)"),
                (": Crate\n", ": Box\n"),
                (":  Crate\n", ":  Box\n"),
                (": Crate (", ": Box ("),
            ),
            "cell.ttl": replaced("cell.ttl", ("o:Crate", "o:Box")),
        },
    ),
    (
        "a relation, in Turtle",
        ("far.trig", "stackedOn", 1),
        "restsOn",
        {name: FILES[name].replace("stackedOn", "restsOn") for name in FILES if name != "words.ttl"},
    ),
    (
        "an enumeration",
        ("a.skill", "Mood {", 1),
        "Temper",
        {
            "a.skill": replaced("a.skill", ("enum Mood", "enum Temper"), (": Mood", ": Temper"), ("Mood-", "Temper-")),
            "cell.ttl": replaced("cell.ttl", ("o:Mood-", "o:Temper-")),
        },
    ),
    (
        "a value",
        ("cell.ttl", "Mood-calm", 6),
        "quiet",
        {
            "a.skill": replaced("a.skill", ("calm", "quiet")),
            "cell.ttl": replaced("cell.ttl", ("o:Mood-calm", "o:Mood-quiet")),
            "skillc.toml": replaced("skillc.toml", ("== calm", "== quiet")),
        },
    ),
    (
        "what `pre of` takes over",
        ("a.skill", "not under ==", 5),
        "lower",
        {"a.skill": replaced("a.skill", ("under", "lower"))},
    ),
    (
        "what a `post some` is on",
        ("a.skill", "not top", 5),
        "upper",
        {"a.skill": replaced("a.skill", ("top", "upper"))},
    ),
    (
        "a property of a vocabulary of the project",
        ("a.skill", "weightClass", 2),
        "lot",
        {
            "a.skill": replaced("a.skill", ("weightClass", "lot")),
            "cell.ttl": replaced("cell.ttl", ("x:weightClass", "x:lot")),
            "words.ttl": replaced("words.ttl", ("extra:weightClass", "extra:lot")),
        },
    ),
]
REFUSALS = [
    (("cell.ttl", "o:Crate ;", 4), "Mood", "there is a `Mood` already, in a.skill"),
    (("cell.ttl", "lab:Crate-8 a", 5), "Crate-7", "there is a `Crate-7` already, in a.skill"),
    (("words.ttl", "Product ;", 1), "Thing2", "`Product` is declared in the ontology"),
    (("words.ttl", "owl:Ontology", 5), "Thing2", "no scene of the project states the class of `Ontology`"),
    (("cell.ttl", "lab:Crate-8 a", 5), "a b", "`a b` is no name: the name of an individual is"),
    (("cell.ttl", "0.5", 1), "half", "nothing here that has a name"),
    (("far.trig", "lab:g", 4), "h", "no scene of the project states the class of `g`"),
]


async def rename(desk: Desk, place: tuple[str, str, int], new: str) -> dict[str, str]:
    """Return the texts of all files after a renaming."""
    name, words, offset = place
    at = desk.at(name, marked(FILES[name], words, offset))
    edit = await desk.client.text_document_rename_async(types.RenameParams(*at, new_name=new))
    assert edit is not None and edit.changes is not None
    texts = dict(FILES)
    for uri, edits in edit.changes.items():
        (file,) = (each for each in texts if desk.uri(each) == uri)
        lines = texts[file].split("\n")
        for each in sorted(edits, key=lambda one: (one.range.start.line, one.range.start.character), reverse=True):
            start, end, line = each.range.start.character, each.range.end.character, each.range.start.line
            assert each.range.end.line == line
            lines[line] = lines[line][:start] + each.new_text + lines[line][end:]
        texts[file] = "\n".join(lines)
    return texts


@pytest.mark.parametrize(("place", "new", "after"), [each[1:] for each in RENAMES], ids=[each[0] for each in RENAMES])
async def test_a_name_is_renamed_in_all_texts_of_a_project(
    desk: Desk, place: tuple[str, str, int], new: str, after: dict[str, str]
) -> None:
    write(desk)
    assert await rename(desk, place, new) == {**FILES, **after}


@pytest.mark.parametrize(("place", "new", "reason"), REFUSALS)
async def test_what_cannot_be_renamed_says_why(desk: Desk, place: tuple[str, str, int], new: str, reason: str) -> None:
    write(desk)
    with pytest.raises(JsonRpcException, match=reason):
        await rename(desk, place, new)


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("more.jsonld", '{"@id": "http://example.org/lab#Crate-8"}', "in more.jsonld, which is not Turtle"),
        (
            "skillc.toml",
            MANIFEST.replace("mood == calm", "mood == calm and (and)").replace("Crate-8 and", "Crate-7 and"),
            "in a goal of skillc.toml that is not read",
        ),
        ("skillc.toml", MANIFEST.replace("7 stackedOn", "7 \\u0073tackedOn"), "in skillc.toml, `tidy`, with escapes"),
    ],
)
async def test_what_is_named_where_nothing_is_edited_is_not_renamed(
    desk: Desk, name: str, text: str, reason: str
) -> None:
    write(desk)
    (desk.folder / name).write_text(text, "utf-8")
    with pytest.raises(JsonRpcException, match=f"is also named {reason}"):
        await rename(desk, ("cell.ttl", "lab:Crate-7   a" if name == "skillc.toml" else "lab:Crate-8 a", 5), "Box")


async def test_what_a_shipped_scene_states_is_followed_and_not_renamed(desk: Desk) -> None:
    task = 'task go {\n    scene "iiwa_table.ttl"\n    goal  lab:Er|aser-1 is Thing\n}\n'
    at = desk.at("a.skill", f"prefix lab: <http://example.org/lab#>\n{task}")
    (place,) = await desk.client.text_document_definition_async(types.DefinitionParams(*at)) or ()
    assert isinstance(place, types.Location) and place.uri.endswith("/scenes/iiwa_table.ttl")
    with pytest.raises(JsonRpcException, match=r"`Eraser-1` is declared in scenes/iiwa_table\.ttl, outside of this"):
        await desk.client.text_document_rename_async(types.RenameParams(*at, new_name="Board"))


async def places(desk: Desk, place: tuple[str, str, int], asked: str) -> list[tuple[str, str]]:
    """Return the file of each place that is found, and its text up to the end of its line."""
    name, words, offset = place
    at = desk.at(name, marked(FILES[name], words, offset))
    if asked == "definition":
        found = await desk.client.text_document_definition_async(types.DefinitionParams(*at))
    else:
        context = types.ReferenceContext(include_declaration=True)
        params = types.ReferenceParams(context, *at)
        found = await desk.client.text_document_references_async(params)
    told = []
    for each in found if isinstance(found, Sequence) else ():
        assert isinstance(each, types.Location)
        file = each.uri.rsplit("/", 1)[-1]
        told.append((file, FILES[file].split("\n")[each.range.start.line][each.range.start.character :][:14]))
    return told


async def test_names_lead_from_turtle_to_skills_and_back(desk: Desk) -> None:
    write(desk)
    assert await places(desk, ("cell.ttl", "stackedOn", 1), "definition") == [("a.skill", "stackedOn(Crat")]
    assert await places(desk, ("cell.ttl", "Mood-calm", 6), "definition") == [("a.skill", "calm, wild }")]
    assert await places(desk, ("a.skill", "weightClass", 1), "definition") == [("words.ttl", "extra:weightCl")]
    assert await places(desk, ("a.skill", "lab:Crate-8", 1), "definition") == [("cell.ttl", "lab:Crate-8 a ")]
    used = [
        ("a.skill", "stackedOn(Crat"),
        ("a.skill", "stackedOn onto"),
        *[("a.skill", "stackedOn unde")] * 2,
        ("a.skill", "stackedOn onto"),
        *[("a.skill", "stackedOn base")] * 2,
        ("a.skill", "own:stackedOn "),
        ("cell.ttl", "o:stackedOn <h"),
        ("far.trig", "<http://exampl"),
        ("skillc.toml", "stackedOn lab:"),
        ("skillc.toml", "yard:stackedOn"),
    ]
    assert await places(desk, ("cell.ttl", "stackedOn", 1), "references") == used
    assert await places(desk, ("a.skill", "stackedOn(", 1), "references") == used


async def test_hover_shows_what_is_taken_over(desk: Desk) -> None:
    write(desk)
    hover = await desk.client.text_document_hover_async(
        types.HoverParams(*desk.at("a.skill", marked(SKILL, "Clear(crate)", 1)))
    )
    assert hover is not None and isinstance(hover.contents, types.MarkupContent)
    assert "infer under: Crate" in hover.contents.value.rpartition("stands for")[2]
    assert "pre crate stackedOn under" in hover.contents.value
