"""Build cases: `python tests/accept.py` rewrites what each folder of `cases/build` is expected to compile to.

It also rewrites the table of features in the documentation, the JSON Schemas that ship, the clients that are made from
the contract, and the postures with which the page of the studio is tested.

A case holds the `.skill` files of a library, its vocabularies in Turtle, and the artifacts below `expected/`.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import skillc
from docs.manual import MANUAL, manual
from skillc.services.library.schemas import SCHEMAS, format_schema, make_schema
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.emit.write import write
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.load import load

SCHEMA_FILES = Path(skillc.__file__).parent / "schemas"
CASES = Path(__file__).parent / "cases" / "build"


def cases() -> list[Path]:
    """Return the folders of all cases, in order."""
    return sorted(path for path in CASES.iterdir() if path.is_dir())


def built(case: Path) -> dict[str, str]:
    """Compile a case; ValueError with the diagnostics if there is an error."""
    vocabulary = load(_sources(case, "*.ttl"))
    outcome = compile(_sources(case, "*.skill"), vocabulary.value, {}, case.name)
    errors = [each for each in (*vocabulary.diagnostics, *outcome.diagnostics) if each.severity == "error"]
    if errors:
        raise ValueError("\n".join(f"{each.span.path}:{each.span.line}: {each.message}" for each in errors))
    return make_artifacts(outcome.value)


def expected(case: Path) -> dict[str, str]:
    """Return the artifacts that the case expects, by relative path."""
    folder = case / "expected"
    return {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*") if path.is_file()}


def _sources(case: Path, pattern: str) -> list[Source]:
    return [Source(path.name, path.read_text()) for path in sorted(case.glob(pattern))]


def main() -> None:
    """Rewrite the expectations of every case and say what changed; rewrite the list of diagnostics."""
    import run_form
    import run_keywords
    from clients.made import MADE
    from matrix.table import PAGE, page  # only here: tests import this module for the cases alone
    from running_cells import kinematics

    for case in cases():
        before, after = expected(case) if (case / "expected").is_dir() else {}, built(case)
        shutil.rmtree(case / "expected", ignore_errors=True)
        write(after, case / "expected")
        changed = sorted(path for path in before.keys() | after.keys() if before.get(path) != after.get(path))
        sys.stderr.write(f"{case.name}: {', '.join(changed) or 'unchanged'}\n")
    PAGE.write_text(page())
    MANUAL.write_text(manual(), encoding="utf-8")
    run_form.FILE.write_text(run_form.format_form(), encoding="utf-8")
    run_keywords.FILE.write_text(run_keywords.format_keywords(), encoding="utf-8")
    kinematics.FILE.write_text(kinematics.format_cases(), encoding="utf-8")
    for made in MADE:
        made.file.write_text(made.make(), encoding="utf-8")
    for name in SCHEMAS:
        (SCHEMA_FILES / f"{name}.schema.json").write_text(format_schema(make_schema(name)), encoding="utf-8")


if __name__ == "__main__":
    main()
