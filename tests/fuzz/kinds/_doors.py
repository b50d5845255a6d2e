"""The readers of all that a user, a file or a client can give as text, each with the pieces that texts are made of."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import msgspec
import pyoxigraph as ox

from fuzz.kinds._pieces import EVENT, GOALS, JSON, MESSAGES, MODEL, PLAIN, SKILLS, SPARQL, TOML, TURTLE, XML
from fuzz.kinds.texts import shelf, vocabulary
from skillc.cli.layout import TerminalPage
from skillc.contract.values import MAX_BODY_BYTES, check_name, check_why
from skillc.errors import ServiceError
from skillc.lsp.messages import MalformedMessage, MessageReader, MessageWriter
from skillc.server.http.requests import decode_body
from skillc.server.problems import ApiRefusal
from skillc.services.library import compiled_libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.library.source_files import is_vocabulary
from skillc.services.project.manifest import read_manifest
from skillc.services.project.toml_text import LONGEST as LONGEST_TOML
from skillc.services.robot_import.reader import read_robot
from skillc.services.scenery.reading import read_scenery
from skillc.services.tasks.breakpoints import parse_breakpoints
from skillc_compiler.diagnostics.suppressions import find_suppressions
from skillc_compiler.goals.parsing import LONGEST, parse_call, parse_goal
from skillc_compiler.ide.analysis import AnalysisInput, analyse
from skillc_compiler.ide.completion import complete
from skillc_compiler.ide.highlighting import highlight_words
from skillc_compiler.pipeline import compile
from skillc_dsl.encoding import MOST_CHARACTERS
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.parsing.parser import parse as parse_skills
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.rendering import full, sarif
from skillc_dsl.source import Source
from skillc_dsl.token_table import scan_tokens
from skillc_model.skills import SkillLibrary
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.formats.read import UnreadableError, read_content
from skillc_rdf.turtle.editing import Editor
from skillc_rdf.turtle.parser import parse as parse_turtle
from skillc_rdf.vocabulary.load import load
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.recording.history.question import QuestionError, select_calls
from skillc_runtime.recording.reader import EnvelopeDecoder, TraceError
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_in_bulk, read_documents
from skillc_runtime.scene.query import QueryError, run_query
from skillc_runtime.store.address import Address
from skillc_runtime.store.change_json import decode_changes
from skillc_runtime.store.literals import LiteralError, read_literal
from skillc_runtime.world.state.transactions import StoreError

HEAD = (
    "@prefix ex: <http://e/> .\n@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
    "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .\n"
    "@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .\n@prefix lab: <http://example.org/lab#> .\n"
)
RDF_XML = (
    '<?xml version="1.0"?>\n<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"\n'
    ' xmlns:owl="http://www.w3.org/2002/07/owl#" xml:base="http://e">\n'
)


class Door(NamedTuple):
    """A reader: the pieces that its texts are made of, how they begin and end, and the longest that it takes."""

    read: Callable[[str], object]
    pieces: tuple[str, ...]
    frames: tuple[tuple[str, str], ...] = (("", ""),)
    longest: int = MOST_CHARACTERS


def _refusing(read: Callable[[str], object], *refusals: type[Exception]) -> Callable[[str], object]:
    """Return a reader that may refuse a text with these errors."""

    def read_or_refuse(text: str) -> object:
        try:
            return read(text)
        except refusals:
            return None

    return read_or_refuse


def _compile(text: str) -> object:
    source = Source("input.skill", text)
    outcome = compile([source], vocabulary(), shelf(), "own")
    return full.render(outcome.diagnostics, {source.path: source}), sarif.render(outcome.diagnostics, {}, {}, "0")


def _complete(text: str) -> object:
    source = Source("input.skill", text)
    analysis = analyse(AnalysisInput("own", {source.path: source}, shelf(), vocabulary()))
    lines = text.split("\n")
    highlight_words(analysis, source.path)
    return complete(analysis, source.path, len(lines), len(lines[-1]) + 1)


def _edit(text: str) -> object:
    editor = Editor(text, "", lambda iri: iri)
    editor.add("http://e/a0", "http://e/p", ox.NamedNode("http://e/b"))
    return editor.text


def _in_file(name: str, read: Callable[[Path], object]) -> Callable[[str], object]:
    """Return a reader of texts for one of files of that name."""

    def read_text(text: str) -> object:
        with TemporaryDirectory() as folder:
            path = Path(folder, name)
            path.write_text(text, "utf-8", errors="surrogatepass")
            return read(path)

    return read_text


def _scene(text: str) -> object:
    return read_documents([Document.of("scene.ttl", text)], vocabulary())


def _scene_in_bulk(text: str) -> object:
    return load_in_bulk([Document.of("scene.ttl", text)], vocabulary())


@cache
def _library() -> SkillLibrary:
    return compiled_libraries.compile_valid(find_library(SHIPPED / "wiping"))


def _messages(text: str) -> object:
    reader = MessageReader(io.BytesIO(text.encode("utf-8", "replace")), MessageWriter(io.BytesIO()))
    return [*iter(reader.readline, b"")]


def _literals(text: str) -> object:
    known = _library().vocabulary.properties.values()
    kinds = {type(term.type): term for term in known}
    for term in kinds.values():
        for datatype in ("string", "integer", "double", "decimal", "boolean"):
            literal = ox.Literal(text, datatype=ox.NamedNode(f"http://www.w3.org/2001/XMLSchema#{datatype}"))
            _refusing(lambda _, literal=literal, term=term: read_literal(literal, term), LiteralError)("")
    return None


def _query(text: str) -> object:
    return run_query([], text, vocabulary())


def _manifest(text: str) -> object:
    return read_manifest(Source("skillc.toml", text))


def _names(text: str) -> object:
    _refusing(check_name, ValueError)(text)
    return _refusing(check_why, ValueError)(text)


def _detect(text: str) -> object:
    return detect_format.__wrapped__(Source("a.owl", text))


def _goal(text: str) -> object:
    return parse_goal(text, vocabulary(), {f"http://example.org/lab#Box-{n}": ("http://x#K",) for n in range(20)})


def _event(text: str) -> object:
    return EnvelopeDecoder(Path("a")).decode(text.encode("utf-8", "replace"))


def _body(text: str) -> object:
    return decode_body(text.encode("utf-8", "replace"), dict[str, msgspec.Raw])


def _reparse(text: str) -> object:
    memo = Memo()
    return tuple(parse_with(memo, Source("a.skill", f"{text}\n# {end}\n")) for end in "ab")


NO_FRAME = (("", ""),)
RDF = TURTLE + XML + JSON
RDF_FRAMES = (
    *NO_FRAME,
    (HEAD, ""),
    (RDF_XML, "</rdf:RDF>"),
    ('<?xml version="1.0"?>\n', "<rdf:RDF/>"),
    ('{"@context": {}, "@graph": [{}', "]}"),
    ("[", "]"),
)
SKILL_FRAMES = (
    *NO_FRAME,
    ("use skiros\n", ""),
    ("skill A {\n", "}\n"),
    ("impl i of A {\n do ", "}\n"),
    ("task t {\n", "\n}\n"),
)
ROBOT_FRAME, MUJOCO_FRAME = ("<robot name='a'>", "</robot>"), ("<mujoco><worldbody>", "</worldbody></mujoco>")
DOORS = {
    "address": Door(_refusing(Address.parse, StoreError), PLAIN, (*NO_FRAME, ("http://", ""))),
    "body": Door(_refusing(_body, ApiRefusal), JSON, (("{", "}"),), MAX_BODY_BYTES),
    "breakpoint": Door(_refusing(lambda text: parse_breakpoints([text], _library()), ServiceError), PLAIN),
    "bulk": Door(_refusing(_scene_in_bulk, SceneError), RDF, RDF_FRAMES),
    "call": Door(lambda text: parse_call(text, _library(), {}), GOALS, (*NO_FRAME, ("Wipe(surface: ", ")")), LONGEST),
    "changes": Door(_refusing(decode_changes, ValueError), JSON, (("[", "]"),)),
    "colours": Door(lambda text: [*scan_tokens(text)], SKILLS),
    "compile": Door(_compile, SKILLS, SKILL_FRAMES),
    "detect": Door(_detect, RDF, RDF_FRAMES),
    "edit": Door(_refusing(_edit, ValueError), TURTLE, RDF_FRAMES[1:2]),
    "editor": Door(_complete, SKILLS, SKILL_FRAMES),
    "event": Door(_refusing(_event, TraceError), EVENT),
    "format": Door(lambda text: format_source(Source("a.skill", text)), SKILLS, SKILL_FRAMES),
    "goal": Door(_goal, GOALS, longest=LONGEST),
    "is-vocabulary": Door(_in_file("a.owl", is_vocabulary), TURTLE + XML),
    "literal": Door(_literals, PLAIN),
    "manifest": Door(_manifest, TOML, (*NO_FRAME, ('name = "a"\n', "")), LONGEST_TOML // 5),
    "messages": Door(_refusing(_messages, MalformedMessage), MESSAGES),
    "names": Door(_names, PLAIN),
    "page": Door(lambda text: TerminalPage(80).wrap(text), PLAIN),
    "parse": Door(lambda text: parse_skills(Source("a.skill", text)), SKILLS, SKILL_FRAMES),
    "query": Door(_refusing(_query, QueryError), SPARQL, (*NO_FRAME, ("SELECT * { ", "}")), LONGEST),
    "question": Door(_refusing(lambda text: select_calls(RunHistory(task="t"), text), QuestionError), PLAIN),
    "rdf": Door(_refusing(lambda text: read_content(Source("a.owl", text)), UnreadableError), RDF, RDF_FRAMES),
    "reparse": Door(_reparse, SKILLS, SKILL_FRAMES),
    "robot": Door(_refusing(_in_file("a.urdf", read_robot), ServiceError), MODEL, (ROBOT_FRAME, MUJOCO_FRAME), LONGEST),
    "scene": Door(_refusing(_scene, SceneError), RDF, RDF_FRAMES),
    "scenery": Door(
        _refusing(_in_file("a.xml", read_scenery), ServiceError),
        MODEL,
        (("<sdf version='1.6'>", "</sdf>"), ROBOT_FRAME, MUJOCO_FRAME),
        LONGEST,
    ),
    "suppressions": Door(lambda text: [*find_suppressions(Source("a.skill", text))], SKILLS),
    "turtle": Door(lambda text: parse_turtle("a.ttl", text, "", {"ex": "http://e/"}), TURTLE, RDF_FRAMES[:2]),
    "vocabulary": Door(lambda text: load([], [Source("a.ttl", text)]), RDF, RDF_FRAMES),
}
"""Every reader by its name."""
