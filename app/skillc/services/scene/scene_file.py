"""A scene file that is edited as text: names are resolved, and it is written only if the scene has no errors then."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from pathlib import Path

import pyoxigraph as ox

from skillc.errors import ServiceError
from skillc.services.reporting.files import rewrite_file
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import decode, unpack
from skillc_ontology import catalogue
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.turtle.editing import INDENT, Editor
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Node, Parsed
from skillc_rdf.vocabulary.types import Vocabulary, local_name
from skillc_runtime.scene.documents import BASE, Document
from skillc_runtime.scene.load import read_documents, sheet_documents
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.names import NoSuchName, resolve_individual
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
"""The namespace of individuals in a scene that has none yet; its prefix is `lab`."""

_LOCAL = re.compile(r"[A-Za-z_](?:[\w-]*\w)?", re.ASCII)
_PREFIX_LINE = re.compile(r"^@prefix[ \t]+(\S*:[ \t]*)<[^>\n]*>[ \t]*\.[^\n]*\n?", re.MULTILINE)


class SceneFile:
    """A scene file with its world as loaded; `editor` has the text. ServiceError if it is a shipped scene."""

    def __init__(self, path: Path, state: WorldState) -> None:
        if catalogue.ROOT in path.resolve().parents:
            raise ServiceError(f"the shipped scene {path.name} cannot be changed; copy it and edit the copy")
        self.path, self.state = path, state
        source = decode(str(path), unpack(path.read_bytes()))
        form = detect_format(source)
        if form != ox.RdfFormat.TURTLE:
            turtle = path.with_suffix(".ttl")
            convert = f"`skillc world {path} --export turtle -o {turtle}`"
            raise ServiceError(f"{path} is {form.name}, and only Turtle can be edited; convert it first: {convert}")
        self._before = source.text
        self.editor = Editor(self._before, BASE, lambda iri: state.vocabulary.aliases.get(iri, iri))

    @property
    def prefixes(self) -> dict[str, str]:
        """The prefixes of the vocabulary and of the file."""
        return {**self.state.vocabulary.prefixes, **self._parsed().prefixes}

    def find_thing(self, name: str) -> str:
        """Return the IRI of an individual; without a prefix it is one of the file's. ServiceError if unknown."""
        try:
            return resolve_individual(name if ":" in name else self._own_namespace() + name, self.state)
        except NoSuchName as error:
            raise ServiceError(str(error)) from error

    def name_new_thing(self, name: str) -> str:
        """Return the IRI of an individual that does not exist yet. ServiceError if the name is taken or invalid."""
        prefix, colon, local = name.rpartition(":")
        known = self.prefixes
        if colon and prefix not in known:
            raise ServiceError(f"the prefix `{prefix}:` is not declared; the scene has {', '.join(sorted(known))}")
        if not _LOCAL.fullmatch(local):
            raise ServiceError(f"`{name}` cannot be a name: write letters, digits, `-` and `_`, a letter first")
        iri = (known[prefix] if colon else self._own_namespace()) + local
        if self.state.exists(iri):
            raise ServiceError(
                f"{self.state.vocabulary.short(iri)} is in the scene already; `skillc scene move` moves it"
            )
        return iri

    def has_thing(self, name: str) -> bool:
        """Whether the file's own namespace has an individual of this name."""
        return self.state.exists(self._own_namespace() + name)

    def find_class(self, name: str) -> str:
        """Return the IRI of a class; without a prefix its last part is enough. ServiceError if unknown or ambiguous."""
        vocabulary = self.state.vocabulary
        iri = vocabulary.expand(name) if ":" in name else ""
        iri = vocabulary.aliases.get(iri, iri)
        if iri in vocabulary.classes:
            return iri
        local = name.rpartition(":")[2]
        found = sorted(cls for cls in vocabulary.classes if local_name(cls) == local)
        if len(found) == 1 and ":" not in name:
            return found[0]
        near = found or _alike(local, vocabulary)
        declare = f"; a library declares it, as in `class {local} < Container`"
        cure = f"; did you mean {' or '.join(map(vocabulary.short, near))}?" if near else declare
        raise ServiceError(f"there is {'no' if not found else 'more than one'} class {name}{cure}")

    def append(self, subject: str, rows: Sequence[Sequence[tuple[str, Node]]]) -> None:
        """Append statements about a new individual, the pairs of each row on a line of their own."""
        pairs = [pair for row in rows for pair in row]
        self.declare([subject, *(name for name, _ in pairs), *(iri_of(node) for _, node in pairs)])
        text = self.editor.text
        lines = [" ; ".join(self.editor.format_pair(*pair) for pair in row) for row in rows if row]
        block = f"{self.editor.format_node(ox.NamedNode(subject))} " + f" ;\n{INDENT}".join(lines) + " .\n"
        self.editor.text = f"{text.rstrip()}\n\n{block}" if text.strip() else block

    def declare(self, iris: Iterable[str]) -> None:
        """Declare the prefixes that IRIs need, below the last prefix of the file."""
        text, vocabulary = self.editor.text, self.state.vocabulary
        known = {LAB: "lab"} | {base: prefix for prefix, base in vocabulary.prefixes.items()}
        declared = self._parsed().prefixes
        for base in sorted({base for iri in iris for base in known if iri.startswith(base)}):
            if base not in declared.values() and known[base] not in declared:
                text = _with_prefix(text, known[base], base)
        self.editor.text = text

    def write(self) -> bool:
        """Write the edited text, atomically; return whether it differs from the file's.

        ServiceError, and the file unchanged, if the scene would have errors or the file cannot be written.
        """
        if self.editor.text == self._before:
            return False
        after = read_documents([Document(str(self.path), self.editor.text), *sheet_documents()], self.state.vocabulary)
        if not after.ok:
            raise ServiceError(_errors_after(self.path, after.problems))
        rewrite_file(self.path, self._before, self.editor.text)
        return True

    def _parsed(self) -> Parsed:
        return parse(str(self.path), self.editor.text, BASE)

    def _own_namespace(self) -> str:
        """Return the namespace of most individuals that the file describes."""
        subjects = {iri_of(each.subject) for each in self._parsed().statements} & self.state.individuals
        spaces = Counter(iri[: len(iri) - len(local_name(iri))] for iri in sorted(subjects))
        return spaces.most_common(1)[0][0] if spaces else LAB


def _with_prefix(text: str, prefix: str, base: str) -> str:
    """Return a text with one more prefix, aligned as the last one is."""
    lines = list(_PREFIX_LINE.finditer(text))
    if not lines:
        return f"@prefix {prefix}: <{base}> .\n{text}"
    last = lines[-1]
    line = f"@prefix {f'{prefix}: '.ljust(len(last[1]))}<{base}> .\n"
    gap = "" if last[0].endswith("\n") else "\n"
    return text[: last.end()] + gap + line + text[last.end() :]


def _alike(local: str, vocabulary: Vocabulary) -> list[str]:
    by_name = {local_name(cls): cls for cls in sorted(vocabulary.classes)}
    return [by_name[each] for each in get_close_matches(local, by_name, n=3)]


def _errors_after(scene: Path, problems: Sequence[Diagnostic]) -> str:
    """Return the message about the errors that the scene would have."""
    errors = (each for each in problems if each.severity == "error")
    lines = (f"  {each.message}" + (f" ({each.help})" if each.help else "") for each in errors)
    return "\n".join((f"{scene} is unchanged, because the scene would have errors", *lines))
