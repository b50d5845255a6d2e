"""Edits of a scene's file from the command line: all of them or none, and only to a scene that is in order."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import click
import pyoxigraph as ox

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.turtle.editing import Editor, NotWritten
from skillc_compiler.turtle.parser import parse
from skillc_compiler.turtle.statements import Node
from skillc_dsl.encoding import decode
from skillc_ontology import catalogue
from skillc_runtime.commands import _writing
from skillc_runtime.scene.documents import BASE, WELL_KNOWN, Document, SceneError
from skillc_runtime.scene.load import scene_of, sheet_documents
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.world_state import WorldState

FORMS = "`SUBJECT PREDICATE VALUE`, `not SUBJECT PREDICATE VALUE` or `not INDIVIDUAL`"


class EditError(ValueError):
    """An edit that cannot be made; the message says why."""


class Wanted(NamedTuple):
    """What an edit says: a statement, or an individual alone, that is to be or not to be."""

    wanted: bool
    subject: str
    predicate: str | None = None
    object: Node | None = None


def edit(scene: Path, state: WorldState, edits: Sequence[str]) -> str:
    """Edit a scene's file and return what was done; EditError or SceneError, and then the file is as it was."""
    if catalogue.ROOT in scene.resolve().parents:
        raise EditError(f"the shipped scene {scene.name} is not changed; copy it and edit the copy")
    before = decode(str(scene), scene.read_bytes()).text
    editor = Editor(before, BASE, lambda iri: state.vocabulary.aliases.get(iri, iri))
    prefixes = {**state.vocabulary.prefixes, **parse(str(scene), before, BASE).prefixes}
    for text in edits:
        _make(editor, text, _understood(text, prefixes, state.vocabulary), state)
    if editor.text == before:
        return f"{scene} says so already"
    after = scene_of([Document(str(scene), editor.text), *sheet_documents()], state.vocabulary)
    if not after.ok:
        raise SceneError(after.problems)
    try:
        _writing.rewrite(scene, before, editor.text)
    except _writing.WriteError as error:
        raise EditError(str(error)) from error
    return f"{scene}: {len(edits)} edit{'s' * (len(edits) > 1)} made"


def _make(editor: Editor, text: str, wanted: Wanted, state: WorldState) -> None:
    """Make an edit in the text; what has one value only is set."""
    subject, predicate, object_ = wanted.subject, wanted.predicate, wanted.object
    try:
        if predicate is None or object_ is None:
            editor.forget(subject)
        elif not wanted.wanted:
            editor.remove(subject, predicate, object_)
        elif _has_one_value(predicate, state.vocabulary):
            editor.set(subject, predicate, object_)
        else:
            editor.add(subject, predicate, object_)
    except NotWritten:
        raise EditError(_not_there(text, wanted, state)) from None


def _has_one_value(predicate: str, vocabulary: Vocabulary) -> bool:
    term = vocabulary.relations.get(predicate) or vocabulary.properties.get(predicate)
    return term is not None and term.functional


def _not_there(text: str, wanted: Wanted, state: WorldState) -> str:
    said = text.strip().removeprefix("not ")
    object_ = iri_of(wanted.object) if wanted.object is not None else ""
    if wanted.predicate in state.vocabulary.relations and state.holds(wanted.subject, wanted.predicate, object_):
        return f"the scene's file does not say `{said}`: it follows from something else, which is to be taken away"
    return f"the scene's file does not say `{said}`"


def _understood(text: str, prefixes: dict[str, str], vocabulary: Vocabulary) -> Wanted:
    """Read an edit; EditError where it makes no sense."""
    said = text.strip().removesuffix(".").strip()
    wanted = not said.startswith("not ")
    said = said if wanted else said.removeprefix("not ").strip()
    alone = not wanted and len(said.split()) == 1
    known = {**dict(WELL_KNOWN), **prefixes}
    head = "".join(f"@prefix {name}: <{iri}> .\n" for name, iri in sorted(known.items()))
    parsed = parse("edit", f"{head}{said}{' a <x:y>' if alone else ''} .\n", BASE)
    if parsed.problems:
        problem = parsed.problems[0]
        raise EditError(f"`{text}`: {problem.message}" + (f"; {problem.help}" if problem.help else ""))
    if len(parsed.statements) != 1 or not isinstance(parsed.statements[0].subject, ox.NamedNode):
        raise EditError(f"`{text}` is not one statement; write {FORMS}")
    (statement,) = parsed.statements
    if alone:
        return Wanted(False, iri_of(statement.subject))
    named = vocabulary.aliases.get(statement.predicate, statement.predicate)
    return Wanted(wanted, iri_of(statement.subject), named, statement.object)


def tell(error: SceneError, scene: Path) -> None:
    """Say why the scene would not be in order."""
    click.echo(f"error: {scene} is left as it is, for after the edit it would have errors", err=True)
    for problem in error.problems:
        if problem.severity == "error":
            click.echo(f"  {problem.message}" + (f" ({problem.help})" if problem.help else ""), err=True)
