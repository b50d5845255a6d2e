"""Files that are odd, or no scenes: each gets a clear answer."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.library import libraries
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene

TEXT = catalogue.scene_path("iiwa_table").read_bytes()
LABEL = b'"rough table"'
LABEL_LINE = TEXT[: TEXT.index(LABEL)].count(b"\n") + 1


def problems(path: Path, content: bytes) -> tuple[Diagnostic, ...]:
    path.write_bytes(content)
    try:
        load_scene(path, libraries.load_vocabulary())
    except SceneError as error:
        return error.problems
    return ()


@pytest.mark.parametrize("content", [b"\xef\xbb\xbf" + TEXT, TEXT.replace(b"\n", b"\r\n"), TEXT + b"# end"])
def test_marks_of_editors_do_not_matter(tmp_path: Path, content: bytes) -> None:
    assert problems(tmp_path / "scene.ttl", content) == ()


WRONG = [
    (b"", "empty-scene", 1),
    (b"\n# nothing\n", "empty-scene", 1),
    (TEXT.replace(LABEL, b'"rough t\xe4ble"'), "unreadable-scene", LABEL_LINE),
    (TEXT.decode().encode("utf-16"), "unreadable-scene", 1),
    (TEXT.decode().encode("utf-16-le"), "unreadable-scene", 1),
    (b'<?xml version="1.0"?><rdf:RDF/>', "unreadable-scene", 1),
    (b'{"@context": {}}', "empty-scene", 1),
    (b"lab:x a lab:y .", "unknown-prefix", 1),
    (b"\x00\x01\x02", "unreadable-scene", 1),
]


@pytest.mark.parametrize(("content", "name", "line"), WRONG)
def test_what_is_no_scene_is_told_once(tmp_path: Path, content: bytes, name: str, line: int) -> None:
    found = [problem for problem in problems(tmp_path / "scene.ttl", content) if problem.name != "unknown-class"]
    assert [(problem.name, problem.span.line) for problem in found] == [(name, line)]


def test_columns_count_characters_behind_a_mark_and_before_a_carriage_return(tmp_path: Path) -> None:
    text = "\ufeff@prefix : <http://e/> .\r\n:x a :ä, 'é' .\r\n"
    found = problems(tmp_path / "scene.ttl", text.encode())
    assert [(p.name, p.span.line, p.span.column) for p in found] == [
        ("not-understood", 2, 6),
        ("unknown-class", 2, 10),
    ]


def test_a_folder_is_no_scene(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="cannot read"):
        load_scene(tmp_path, libraries.load_vocabulary())
