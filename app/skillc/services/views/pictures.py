"""Makes pictures of skills and tasks, as nested boxes."""

from __future__ import annotations

from pathlib import Path

from skillc.errors import RequestError
from skillc.services.library.artifacts import parse_files
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_compiler.emit.picture.drawing import list_drawable, make_picture
from skillc_dsl.spelling import did_you_mean


def draw_declaration(path: Path, name: str) -> PictureBox:
    """Return the picture of a skill or task of the library at `path`. RequestError if it has no such declaration."""
    library = find_library(path)
    compile_valid(library)
    files = parse_files(library)
    box = make_picture(name, files)
    if box is None:
        names = list_drawable(files)
        hint = did_you_mean(name, names) or (f"there is {', '.join(names)}" if names else "it has none")
        raise RequestError(f"there is no skill or task `{name}` in {library.name}; {hint}")
    return box
