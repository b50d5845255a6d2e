"""What an author writes instead of a name that a library once had: `# former NAME: ADVICE`, in a skill or outside."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType

from skillc_compiler.program.typed import ParsedFile
from skillc_compiler.program.unknown import LIBRARY
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix

_FORMER = re.compile(r"^[ \t]*# former (\w+): (\S.*)$", re.MULTILINE)
_RENAMED = re.compile(r"write `(\w+)`")
FormerNames = Mapping[tuple[str, str], str]
"""The advice for each name, by its skill and the name; skills and functions belong to LIBRARY."""
NONE: FormerNames = MappingProxyType({})


def find_former_names(files: Iterable[ParsedFile]) -> FormerNames:
    """Return what the comments of files say about names that are no more."""
    found: dict[tuple[str, str], str] = {}
    for unit in files:
        if "# former " not in unit.text:
            continue
        skills = {each.span: each for each in unit.file.declarations if isinstance(each, s.SkillDeclaration)}
        for match in _FORMER.finditer(unit.text):
            line = unit.text.count("\n", 0, match.start()) + 1
            around = next((each for span, each in skills.items() if span.line <= line <= span.end_line), None)
            found[around.name.text if around else LIBRARY, match[1]] = match[2].strip()
    return found


def with_advice(problem: Diagnostic, advice: str) -> Diagnostic:
    """Return the problem with an unknown name with what to do about it; another name is a fix."""
    renamed = _RENAMED.match(advice)
    fix = Fix(problem.span, renamed[1], f"write `{renamed[1]}`", safe=False) if renamed else None
    return replace(problem, message=f"{problem.message} any more", help=advice, fix=fix)
