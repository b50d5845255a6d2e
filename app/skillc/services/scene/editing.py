"""Edits a scene file: either all edits are applied or none, and only if the scene has no errors afterwards."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import pyoxigraph as ox

from skillc.errors import RequestError, ServiceError
from skillc.services.scene.fact_text import FORMS, write_statement
from skillc.services.scene.scene_file import SceneFile
from skillc_rdf.turtle.editing import Editor, StatementNotFound
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Node
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import BASE, WELL_KNOWN
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.world_state import WorldState


class StatementEdit(NamedTuple):
    """A statement to add or remove, or an individual (without predicate) to remove."""

    added: bool
    subject: str
    predicate: str | None = None
    object: Node | None = None


def edit_file(scene: Path, state: WorldState, edits: Sequence[str]) -> str:
    """Edit a scene file and return a summary. ServiceError, and the file unchanged, if an edit cannot be applied."""
    file = SceneFile(scene, state)
    prefixes = file.prefixes
    for text in edits:
        _apply(file.editor, text, parse_edit(text, prefixes, state.vocabulary), state)
    if not file.write():
        return f"{scene} already states this"
    return f"{scene}: {len(edits)} edit{'s' * (len(edits) > 1)} applied"


def _apply(editor: Editor, text: str, edit: StatementEdit, state: WorldState) -> None:
    """Apply an edit to the text; the value of a functional relation or property is replaced."""
    subject, predicate, object_ = edit.subject, edit.predicate, edit.object
    try:
        if predicate is None or object_ is None:
            editor.forget(subject)
        elif not edit.added:
            editor.remove(subject, predicate, object_)
        elif _has_one_value(predicate, state.vocabulary):
            editor.set(subject, predicate, object_)
        else:
            editor.add(subject, predicate, object_)
    except StatementNotFound:
        raise ServiceError(_not_written(text, edit, state)) from None


def _has_one_value(predicate: str, vocabulary: Vocabulary) -> bool:
    term = vocabulary.relations.get(predicate) or vocabulary.properties.get(predicate)
    return term is not None and term.functional


def _not_written(text: str, edit: StatementEdit, state: WorldState) -> str:
    said = text.strip().removeprefix("not ")
    object_ = iri_of(edit.object) if edit.object is not None else ""
    if edit.predicate in state.vocabulary.relations and state.holds(edit.subject, edit.predicate, object_):
        return f"the scene file does not state `{said}`: it follows from other statements; remove those"
    return f"the scene file does not state `{said}`"


def parse_edit(text: str, prefixes: dict[str, str], vocabulary: Vocabulary) -> StatementEdit:
    """Parse an edit, a fact as it is shown or a statement of Turtle; ServiceError if it is not a valid one."""
    said = text.strip().removesuffix(".").strip()
    wanted = not said.startswith("not ")
    said = said if wanted else said.removeprefix("not ").strip()
    try:
        said = write_statement(said, vocabulary)
    except RequestError as error:
        raise ServiceError(f"`{text}`: {error}") from error
    alone = not wanted and len(said.split()) == 1
    known = {**dict(WELL_KNOWN), **prefixes}
    head = "".join(f"@prefix {name}: <{iri}> .\n" for name, iri in sorted(known.items()))
    parsed = parse("edit", f"{head}{said}{' a <x:y>' if alone else ''} .\n", BASE)
    if parsed.problems:
        problem = parsed.problems[0]
        raise ServiceError(f"`{text}`: {problem.message}" + (f"; {problem.help}" if problem.help else ""))
    if len(parsed.statements) != 1 or not isinstance(parsed.statements[0].subject, ox.NamedNode):
        raise ServiceError(f"`{text}` is not one fact; write {FORMS}")
    (statement,) = parsed.statements
    if alone:
        return StatementEdit(False, iri_of(statement.subject))
    named = vocabulary.aliases.get(statement.predicate, statement.predicate)
    return StatementEdit(wanted, iri_of(statement.subject), named, statement.object)
