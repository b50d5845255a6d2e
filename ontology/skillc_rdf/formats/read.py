"""Reads the triples of a text in any format that is supported; all graphs of a file are one, but for `skillc:truth`.

What parsers of other formats do not survive (entities that expand to gigabytes, brackets nested thousands deep) and
what they would need the network for is reported before they start.
"""

from __future__ import annotations

import re
from urllib.parse import quote
from xml.parsers import expat

import msgspec
import pyoxigraph as ox

from skillc_dsl.source import Source
from skillc_rdf.formats import json_ld
from skillc_rdf.formats.detect import UnsupportedFormat, detect_format
from skillc_rdf.formats.owl_syntax import NotOwlError, OwlSyntax, convert_to_xml, find_too_much

DEEPEST = 200
"""The greatest depth of nested elements, objects and lists."""
MOST_MEGABYTES = 16
"""The greatest length of one text in a file, in MB, which is the parser's."""
TRUTH = ox.NamedNode("https://w3id.org/skillc/core#truth")
"""The graph of what is true in a scene, but not known."""
NEEDED = "pip install 'skillc[ontologies]', or save the file as Turtle or RDF/XML, which Protégé and ROBOT do"
"""What to do about a syntax of OWL without the extra that reads it."""
_SINGLE_QUOTED = re.compile(r"(<!ENTITY\s+[\w.-]+\s+)'([^'\"]*)'")
_ENCODING = re.compile(r"\A(<\?xml[^>]*?)\sencoding\s*=\s*[\"'][\w.-]+[\"']")


class UnreadableError(ValueError):
    """A text that cannot be read; the message says why, with the line and the column from 1."""

    def __init__(self, message: str, help: str = "", line: int = 1, column: int = 1) -> None:
        super().__init__(message)
        self.help, self.line, self.column = help, line, column


class Content(msgspec.Struct, frozen=True):
    """The triples of a text in order, the prefixes that it declares, and the triples of its graph `skillc:truth`."""

    triples: tuple[ox.Triple, ...]
    prefixes: dict[str, str]
    truth: tuple[ox.Triple, ...] = ()


def read_content(source: Source, base: str | None = None) -> Content:
    """Read a text; relative IRIs are resolved against `base`, by default the file's. UnreadableError."""
    form = detect_format(source)
    if isinstance(form, UnsupportedFormat):
        raise UnreadableError(f"this file is {form.name}, which is not supported", form.help)
    if isinstance(form, OwlSyntax):
        return _read_owl(source, form, base)
    text = _checked(source.text, form)
    content = _parse(source, text, form, base)
    is_json = form == ox.RdfFormat.JSON_LD
    return msgspec.structs.replace(content, prefixes=json_ld.find_prefixes(text)) if is_json else content


def _parse(source: Source, text: str, form: ox.RdfFormat, base: str | None) -> Content:
    """Parse what a source says in a format that the parser has; UnreadableError."""
    try:
        parser = ox.parse(text, form, base_iri=base or _file_iri(source), rename_blank_nodes=True)
        quads = tuple(parser)
    except SyntaxError as error:
        reason = (error.msg or "").rpartition(": ")[2] or "it is not complete"
        raise _wrong(form.name, reason, error.lineno or 1, error.offset or 1) from error
    except MemoryError as error:
        raise UnreadableError(f"a text in this file is longer than {MOST_MEGABYTES} MB", "shorten the text") from error
    known = tuple(each.triple for each in quads if each.graph_name != TRUTH)
    return Content(known, parser.prefixes, tuple(each.triple for each in quads if each.graph_name == TRUTH))


def _read_owl(source: Source, syntax: OwlSyntax, base: str | None) -> Content:
    """Read a syntax of OWL that is not RDF; UnreadableError."""
    text = _checked_xml(source.text, syntax.name) if syntax.serialization == "owx" else source.text
    much = find_too_much(text, syntax, DEEPEST)
    if much is not None:
        what = "this file cannot be read: it is nested too deeply, or has too long a list of literals"
        raise UnreadableError(what, json_ld.FLATTEN, *_place(text, much))
    try:
        converted, prefixes = convert_to_xml(text, syntax)
    except ModuleNotFoundError as error:
        raise UnreadableError(f"this file is {syntax.name}, which needs {error.name}", NEEDED) from error
    except NotOwlError as error:
        raise _wrong(syntax.name, str(error), *_place(text, error.offset)) from error
    return Content(_parse(source, converted, ox.RdfFormat.RDF_XML, base).triples, prefixes)


def _place(text: str, offset: int) -> tuple[int, int]:
    """Return the line and the column from 1 of an offset."""
    before = text[:offset]
    return before.count("\n") + 1, offset - before.rfind("\n")


def _checked(text: str, form: ox.RdfFormat) -> str:
    """Return a text that the parser can be given; UnreadableError."""
    if form == ox.RdfFormat.RDF_XML:
        return _checked_xml(text, form.name)
    if form == ox.RdfFormat.JSON_LD:
        problem = json_ld.find_problem(text, DEEPEST)
        if problem is not None:
            raise UnreadableError(*problem)
    return text


def _checked_xml(text: str, form: str) -> str:
    """Return XML as the parser needs it; UnreadableError if it is not well-formed, or refers to other files."""
    parser = expat.ParserCreate()
    depth = 0

    def start(_name: str, _attributes: object) -> None:
        nonlocal depth
        depth += 1
        if depth > DEEPEST:
            line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
            raise UnreadableError("this file cannot be read: it is nested too deeply", json_ld.FLATTEN, line, column)

    def end(_name: str) -> None:
        nonlocal depth
        depth -= 1

    def entity(name: str, _is_parameter: int, value: str | None, *_where: object) -> None:
        if value is None:
            help_ = f"write the text of `{name}` into the file"
            line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
            raise UnreadableError(f"the entity `{name}` is in another file, which is not read", help_, line, column)

    parser.StartElementHandler, parser.EndElementHandler, parser.EntityDeclHandler = start, end, entity
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        reason = expat.errors.messages.get(error.code, str(error))
        raise _wrong(form, reason, error.lineno, error.offset + 1) from error
    text = _SINGLE_QUOTED.sub(r'\1"\2"', text)
    return _ENCODING.sub(r"\1", text, count=1) if text.isascii() else text


def _file_iri(source: Source) -> str:
    return f"file:///{quote(source.path.lstrip('/'))}"


def _wrong(form: str, reason: str, line: int, column: int) -> UnreadableError:
    help_ = "correct the file; until then all of it is ignored"
    return UnreadableError(f"this file is not {form}: {reason}", help_, line, column)
