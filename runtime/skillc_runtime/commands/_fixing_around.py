"""Fixes of what stands around the skills: scenes and vocabularies of the user's, in Turtle."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes, drop_overlapping
from skillc_dsl.encoding import REPLACEMENT, decode
from skillc_ontology import catalogue
from skillc_runtime.commands._writing import rewrite


@dataclass(frozen=True, slots=True)
class Mended:
    """A file as it is and as it shall be, after how many fixes."""

    path: Path
    before: str
    after: str
    fixes: int


def mended(found: Iterable[Diagnostic], unsafe: bool) -> tuple[Mended, ...]:
    """Return the files in Turtle that fixes change, the safe ones or all; what ships with skillc is left alone."""
    fixes: dict[Path, list[Fix]] = defaultdict(list)
    for fix in (each.fix for each in found):
        if fix is not None and (fix.safe or unsafe) and _is_own(Path(fix.span.path)):
            fixes[Path(fix.span.path)].append(fix)
    return tuple(each for path, chosen in sorted(fixes.items()) if (each := _mended(path, chosen)) is not None)


def write(files: Iterable[Mended]) -> None:
    """Write files. WriteError at the first that cannot be written."""
    for each in files:
        rewrite(each.path, each.before, each.after)


def _is_own(path: Path) -> bool:
    turtle = path.suffix == ".ttl" and path.is_file()
    return turtle and not path.resolve().is_relative_to(catalogue.ROOT.resolve())


def _mended(path: Path, fixes: list[Fix]) -> Mended | None:
    text = decode(str(path), path.read_bytes()).text
    chosen = drop_overlapping(dict.fromkeys(fixes))
    if REPLACEMENT in text or not chosen:
        return None
    return Mended(path, text, apply_fixes(text, chosen), len(chosen))
