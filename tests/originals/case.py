"""One case: a library and a scene that use published ontologies, and published scenes; what becomes of them."""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result
from rdflib import RDFS, Graph, Literal, URIRef
from rdflib.compare import isomorphic
from rdflib.plugins.parsers.notation3 import BadSyntax

from skillc.cli.main import skillc
from skillc.services.library.ontologies import OpenOntologies, open_ontologies
from skillc_rdf.formats.read import read_content
from skillc_rdf.vocabulary.types import Vocabulary

SKILL = """use {use}

## Relate two things: what is planned for.
skill Relate {{
    in one:   {one}
    in other: {other}

    pre  apart:  not one {relation} other
    post linked: one {relation} other

    duration 1 s
}}

impl by_hand of Relate {{
    run python "skillc.primitives:StandIn"
}}
"""
LAB = "http://example.org/lab#"
NOTE = Literal("edited here")


@dataclass
class Row:
    """What becomes of a case: `failures` says what did not do; `conflicts` counts those that do not matter."""

    name: str
    triples: int = 0
    seconds: float = 0.0
    warnings: int = 0
    used: str = ""
    scenes: int = 0
    loaded: int = 0
    unharmed: int = 0
    failures: list[str] = field(default_factory=list)


def run_case(case: Mapping[str, Any], folder: Path, work: Path) -> Row | None:
    """Try a case in a new folder `work`; None if its ontologies are not below `folder`."""
    row = Row(case["name"])
    files = list(find_files(folder, case["files"]))
    if not files:
        return None
    ontology = work / "ontology"
    ontology.mkdir(parents=True)
    for file in files:
        shutil.copy(file, ontology / file.name)
    begun = time.process_time()
    opened = open_ontologies(sorted(ontology.iterdir()))
    row.triples = sum(len(read_content(each).triples) for each in opened.sources.values())
    _try_library(case, opened, work, row)
    for scene in find_files(folder, case.get("scenes", [])):
        if scene.name not in case.get("wrong", ()):
            _try_scene(scene, ontology, work, row)
    row.seconds = time.process_time() - begun
    return row


def find_files(folder: Path, patterns: Sequence[str]) -> Iterator[Path]:
    """Yield the files whose paths below a folder end as a pattern says; of files of one name the one nearest to it."""
    for pattern in patterns:
        found = (path for path in folder.rglob(pattern.rpartition("/")[2]) if path.match(f"*{pattern}"))
        nearest = sorted(found, key=lambda path: (-len(path.parts), path))
        yield from sorted({path.name: path for path in nearest if path.is_file()}.values())


def _try_library(case: Mapping[str, Any], opened: OpenOntologies, work: Path, row: Row) -> None:
    """Check a library of one skill, plan with it, and edit its scene."""
    library, ontology = work / "library", work / "ontology"
    library.mkdir()
    terms = {key: _short(case[key], opened.vocabulary, row) for key in ("one", "relation", "other")}
    prefixes = sorted({name.partition(":")[0] for name in terms.values()})
    (library / "relate.skill").write_text(SKILL.format(use=", ".join(prefixes), **terms), "utf-8")
    object_ = case.get("object", f"{LAB}Other")
    scene = library / "scene.ttl"
    described = "" if "object" in case else f"<{object_}> a <{case['other']}> .\n"
    scene.write_text(
        f"@prefix lab: <{LAB}> .\n{case.get('extra', '')}<{LAB}One> a <{case['one']}> .\n{described}", "utf-8"
    )
    checked = run("check", library, "--ontology", ontology, "--scene", scene, "--json", "--no-cache")
    found = json.loads(checked.stdout) if checked.stdout else [{"severity": "error", "message": checked.stderr}]
    row.warnings = sum(each["severity"] == "warning" for each in found)
    row.failures += [f"check: {each['message']}" for each in found if each["severity"] == "error"]
    object_name = case.get("object_name", "lab:Other")
    goal = f"<{LAB}One> <{case['relation']}> <{object_}>"
    named = f"lab:One {terms['relation']} {object_name}"
    planned = run(
        "plan", "--goal", named, "--scene", scene, "--library", library, "--ontology", ontology, "--no-plan-cache"
    )
    if planned.exit_code or "Relate" not in planned.stdout:
        row.failures.append(f"plan: {_errors(planned)}")
    row.used = ", ".join(terms.values())
    _edit(scene, f"{goal} .", (URIRef(f"{LAB}One"), URIRef(case["relation"]), URIRef(object_)), work, row)


def _try_scene(original: Path, ontology: Path, work: Path, row: Row) -> None:
    """Load a published scene, edit it, and look whether all else is as it was; what is not Turtle is left out."""
    try:
        Graph().parse(original, format="turtle", publicID="file:///scene")
    except BadSyntax:
        return
    row.scenes += 1
    scene = work / original.with_suffix(".ttl").name
    shutil.copy(original, scene)
    loaded = run("world", scene, "--json", "--ontology", ontology)
    if loaded.exit_code:
        row.failures.append(f"{original.name}: {_errors(loaded)}")
        return
    row.loaded += 1
    graph = Graph().parse(scene, format="turtle", publicID="file:///scene")
    subject = min(each for each in graph.subjects(unique=True) if isinstance(each, URIRef))
    edit = f'<{subject}> <{RDFS.label}> "{NOTE}" .'
    _edit(scene, edit, (subject, RDFS.label, NOTE), work, row)


def _edit(scene: Path, edit: str, added: tuple[Any, Any, Any], work: Path, row: Row) -> None:
    """Edit a scene file; exactly one triple has to be new, as rdflib reads it."""
    before = Graph().parse(scene, format="turtle", publicID="file:///scene")
    edited = run("scene", "edit", scene, edit, "--library", work / "library", "--ontology", work / "ontology")
    if edited.exit_code:
        row.failures.append(f"edit of {scene.name}: {_errors(edited)}")
        return
    before.add(added)
    after = Graph().parse(scene, format="turtle", publicID="file:///scene")
    if isomorphic(before, after):
        row.unharmed += 1
    else:
        row.failures.append(f"edit of {scene.name}: more than one triple differs")


def _short(iri: str, vocabulary: Vocabulary, row: Row) -> str:
    """Return a term as a skill names it."""
    known = vocabulary.aliases.get(iri, iri)
    if not any(known in terms for terms in (vocabulary.classes, vocabulary.relations)):
        row.failures.append(f"there is no term {iri}")
    return vocabulary.short(known)


def _errors(result: Result) -> str:
    """Return the lines that say what is wrong."""
    lines = [each for each in result.stderr.splitlines() if "error" in each.partition(" ")[0]]
    return "; ".join(lines[:3]) or result.output[-300:]


def run(*arguments: str | Path) -> Result:
    """Run a command; the exit code of one that crashes is 70."""
    result = CliRunner().invoke(skillc, [str(each) for each in arguments])
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result
