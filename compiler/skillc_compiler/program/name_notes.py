"""What comments in libraries say of names.

`# former NAME: ADVICE`, in a skill or outside, says what to write instead of a name that is no more. With `until
edition N` before the colon, files up to this edition may still write it; the advice begins with the present name.
`# since edition N` at the end of the first line of a skill or function says with which edition it came.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.unknown import LIBRARY
from skillc_dsl import syntax as s
from skillc_dsl.editions import NEWEST

RENAMED = re.compile(r"write `(\w+)`")
_FORMER = re.compile(r"^[ \t]*# former (\w+)(?: until edition (\d+))?: (\S.*)$", re.MULTILINE)
_SINCE = re.compile(r"^(?:skill|function)[ \t]+(\w+)\b.*# since edition (\d+)$", re.MULTILINE)
KeptNames: TypeAlias = Mapping[tuple[str, str], str]
"""The present name of each former one, by its skill and the name; skills and functions belong to LIBRARY."""
NO_NAMES: KeptNames = MappingProxyType({})


class FormerName(NamedTuple):
    """A name that is no more, of the skill `owner` or of LIBRARY, and what to do instead.

    Up to the edition `until` it may be written; None if it may not.
    """

    owner: str
    name: str
    advice: str
    until: int | None


def find_former_names(files: Iterable[ParsedFile]) -> Iterator[FormerName]:
    """Yield what the comments of files say about names that are no more."""
    for unit in files:
        if "# former " not in unit.text:
            continue
        skills = {each.span: each for each in unit.file.declarations if isinstance(each, s.SkillDeclaration)}
        for match in _FORMER.finditer(unit.text):
            line = unit.text.count("\n", 0, match.start()) + 1
            around = next((each for span, each in skills.items() if span.line <= line <= span.end_line), None)
            until = int(match[2]) if match[2] else None
            yield FormerName(around.name.text if around else LIBRARY, match[1], match[3].strip(), until)


def find_kept_names(files: Iterable[ParsedFile], edition: int) -> KeptNames:
    """Return the former names that files of an edition may still write."""
    if edition == NEWEST:
        return NO_NAMES
    found = (each for each in find_former_names(files) if each.until is not None and each.until >= edition)
    return {(each.owner, each.name): now[1] for each in found if (now := RENAMED.match(each.advice))}


def find_later_names(unit: ParsedFile) -> dict[str, int]:
    """Return the skills and functions of a file that came after the first edition, with the edition of each."""
    return {match[1]: int(match[2]) for match in _SINCE.finditer(unit.text)} if "# since edition " in unit.text else {}
