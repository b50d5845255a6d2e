"""Skills that a file can import, and the edit that adds the `import` line."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping

from skillc_compiler.ide.analysis import Analysis
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span

STANDARD_LIBRARY = "std/"


def find_importable(analysis: Analysis, path: str) -> Iterator[tuple[s.SkillDeclaration, str]]:
    """Yield the skills of the library and of `std` that are not visible in a file, each with the file to import."""
    seen = set(analysis.visible[path].skills) if path in analysis.visible else set()
    for file, imported in _files(analysis, path).items():
        for declaration in imported.declarations:
            if isinstance(declaration, s.SkillDeclaration) and declaration.name.text not in seen:
                seen.add(declaration.name.text)
                yield declaration, file


def make_import(analysis: Analysis, path: str, file: str) -> Fix:
    """Return the edit that adds an `import` line at the end of the header."""
    header = next((unit.file.header for unit in analysis.program.files if unit.file.path == path), ())
    line = header[-1].span.end_line + 1 if header else 1
    return Fix(Span(path, line, 1, line, 1), f'import "{file}"\n', f"import {file}")


def _files(analysis: Analysis, path: str) -> Mapping[str, s.File]:
    """Return the importable files by the text of their `import`, those of the library first."""
    folder = posixpath.dirname(path) or "."
    own = {
        posixpath.relpath(unit.file.path, folder): unit.file
        for unit in analysis.program.files
        if unit.file.path in analysis.library.sources and unit.file.path != path
    }
    shipped = (item for item in analysis.library.importable.items() if item[1].path.startswith(STANDARD_LIBRARY))
    standard = {name: analysis.parsed_by(source).value for name, source in shipped if name not in own}
    return {**own, **standard}
