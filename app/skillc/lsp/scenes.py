"""The scenes of a library's tasks, and what is wrong in them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from skillc.services.check.library_checks import check_with_scenes
from skillc.services.library.files import LibraryFiles
from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.annotations.hints import CallChoice, Choices
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.encoding import unpack
from skillc_dsl.query import Memo
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.types import Vocabulary

if TYPE_CHECKING:
    from skillc.services.tasks.scenes import TaskScenes
    from skillc_runtime.scene.load import LoadedScene


def read_scenes(
    program: Program, base: Vocabulary, around: LibraryFiles, folder: Path, buffers: Mapping[Path, str], memo: Memo
) -> TaskScenes | None:
    """Return the scenes of a program's tasks, None if no task has one; `buffers` replace files on disk.

    The world model is imported only if a task has a scene.
    """
    by_default = around.project is not None and around.project.manifest.scene is not None
    if not any(task.scene or by_default for task in program.tasks):
        return None
    from skillc.services.tasks.named_scenes import default_scene
    from skillc.services.tasks.scenes import SceneTexts, read_scene, read_task_scenes

    default = default_scene(around.project) if around.project else None
    own_terms = memo.ask("terms of scenes", (program.vocabulary, base), partial(_own_terms, program.vocabulary, base))
    terms = memo.same("terms of scenes", "", own_terms)

    def read(path: Path, vocabulary: Vocabulary) -> Outcome[LoadedScene | None]:
        text = buffers.get(path)
        written = (path.stat().st_mtime_ns if path.is_file() else 0) if text is None else text
        known = memo.same("text of a scene", path, written)
        name = path, vocabulary.symbolic
        return memo.ask("scene", (base, terms, known), lambda: read_scene(path, vocabulary, text), name)

    texts = SceneTexts(folder.joinpath, str, around.is_symbolic, default)
    return read_task_scenes(program, texts, read=read)


def find_problems(scenes: TaskScenes | None, analysis: Analysis, memo: Memo) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of tasks in their scenes and of text values, without those in shipped files."""
    sources = analysis.library.sources.values()
    found = check_with_scenes(analysis.compiled, analysis.program, scenes, str, sources, memo)
    return tuple(each for each in found if not _is_shipped(each.span.path))


def find_choices(scenes: TaskScenes | None, analysis: Analysis, path: str, lines: range) -> Choices:
    """Return how the calls in the tasks and tests of some lines go in their scenes; none if the library has errors."""
    if scenes is None or not any(each.span.path == path and each.body for each in analysis.program.tasks):
        return {}
    if not analysis.compiled.ok:
        return {}
    from skillc.services.tasks.call_choices import foresee_choices, start_of
    from skillc_model.declared import act_as_declared

    library, found = analysis.compiled.value, dict[tuple[int, int], CallChoice]()
    for each in (*library.tasks.values(), *library.tests.values()):
        scene = scenes.valid.get(scenes.files.get(each.name, Path()))
        is_near = each.source.path == path and each.source.line < lines.stop
        if scene is not None and is_near and each.body is not None and not each.parameters:
            acting = act_as_declared(library) if each.name in library.tests else library
            choices = foresee_choices(each.body, acting, start_of(each, scene.state))
            found |= {(choice.line, choice.column): choice for choice in choices}
    return found


def read_scene_texts(found: Iterable[Diagnostic], buffers: Mapping[Path, str]) -> dict[str, str]:
    """Return the texts of the scenes and manifests that diagnostics point into, by the diagnostics' paths."""
    paths = {span.path for each in found for span in (each.span, *(label.span for label in each.labels))}
    wanted = sorted(path for path in paths if path.endswith((*catalogue.ENDINGS, ".toml")) and Path(path).is_file())
    return {path: read_text(Path(path), buffers) for path in wanted}


def read_text(file: Path, buffers: Mapping[Path, str]) -> str:
    """Return the text of a scene, vocabulary or manifest: that in the editor, or on disk."""
    return buffers[file] if file in buffers else unpack(file.read_bytes()).decode("utf-8-sig", errors="replace")


def _is_shipped(path: str) -> bool:
    return Path(path).resolve().is_relative_to(catalogue.ROOT)


def _own_terms(vocabulary: Vocabulary, base: Vocabulary) -> bytes:
    """Return the terms and prefixes that the library adds to the vocabulary, encoded without their positions."""
    pairs = ((vocabulary.classes, base.classes), (vocabulary.relations, base.relations))
    tables: tuple[tuple[Mapping[str, msgspec.Struct], Mapping[str, msgspec.Struct]], ...] = pairs
    own = [term for mine, theirs in tables for iri, term in mine.items() if theirs.get(iri) != term]
    own += [term for iri, term in vocabulary.properties.items() if base.properties.get(iri) != term]
    return msgspec.json.encode([vocabulary.prefixes, *(msgspec.structs.replace(term, source=None) for term in own)])
