"""Names of skills and functions in libraries of older editions.

What came to a library with a later edition gives way: it gets another name if a library of an older edition declares
one of its name. What had another name up to an edition may still be written so there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, TypeAlias

import msgspec

from skillc_compiler.program.name_notes import find_kept_names, find_later_names
from skillc_compiler.program.program import ParsedFile
from skillc_compiler.program.unknown import LIBRARY
from skillc_dsl import syntax as s
from skillc_dsl.editions import NEWEST

_Names: TypeAlias = Mapping[tuple[str, str], str]
"""The names to give, by the skill that a name belongs to, LIBRARY for skills and functions, and the name."""
_FIELDS: Mapping[type, str] = MappingProxyType(
    {
        s.SkillDeclaration: "name",
        s.FunctionDeclaration: "name",
        s.ImplementationDeclaration: "skill",
        s.CallSkill: "skill",
        s.Invoke: "function",
        s.VerifyEvent: "what",
    }
)
"""Where a syntax tree names a skill or a function."""


def read_older_editions(files: Sequence[ParsedFile]) -> Sequence[ParsedFile]:
    """Return the files with the names that those of older editions mean; they are the same if all are of the newest."""
    older = sorted({unit.edition for unit in files if unit.edition < NEWEST})
    if not older:
        return files
    kept = {edition: find_kept_names(files, edition) for edition in older}
    read = [_rename(unit, kept[unit.edition]) if unit.edition in kept else unit for unit in files]
    giving_way = _find_giving_way(read)
    return [_rename(unit, {key: new for key, (own, new) in giving_way.items() if own != unit.library}) for unit in read]


def _find_giving_way(files: Sequence[ParsedFile]) -> dict[tuple[str, str], tuple[str, str]]:
    """Return the later names that libraries of older editions declare, with the library and the name in all others."""
    later = {name: (unit.library, since) for unit in files for name, since in find_later_names(unit).items()}
    found = {}
    for unit in files if later else ():
        for declared in unit.file.declarations:
            library, since = later.get(declared.name.text, (unit.library, 0))
            if library != unit.library and since > unit.edition:
                found[LIBRARY, declared.name.text] = unit.library, f"{library}_{declared.name.text}"
    return found


def _rename(unit: ParsedFile, names: _Names) -> ParsedFile:
    """Return a file in which skills, functions, and what belongs to skills have other names."""
    if not any(name in unit.text for _, name in names):
        return unit
    declarations = tuple(_renamed(each, names) for each in unit.file.declarations)
    return msgspec.structs.replace(unit, file=msgspec.structs.replace(unit.file, declarations=declarations))


def _renamed(part: Any, names: _Names) -> Any:
    """Return a part of a syntax tree with other names."""
    if isinstance(part, tuple) and not hasattr(part, "_fields"):
        return tuple(_renamed(each, names) for each in part)
    if not isinstance(part, msgspec.Struct):
        return part
    changed = type(part)(**{field: _renamed(getattr(part, field), names) for field in part.__struct_fields__})
    field = _FIELDS.get(type(part))
    if field is not None and isinstance(name := getattr(changed, field), s.Name):
        changed = msgspec.structs.replace(changed, **{field: _with_name(name, LIBRARY, names)})
    return _with_names_of_skill(changed, names) if isinstance(changed, s.CallSkill) else changed


def _with_names_of_skill(call: s.CallSkill, names: _Names) -> s.CallSkill:
    """Return a call with the present names of the implementation and the parameters of its skill."""
    owner = call.skill.text
    return msgspec.structs.replace(
        call,
        implementation=call.implementation and _with_name(call.implementation, owner, names),
        arguments=tuple(
            msgspec.structs.replace(each, name=_with_name(each.name, owner, names)) for each in call.arguments
        ),
    )


def _with_name(name: s.Name, owner: str, names: _Names) -> s.Name:
    return msgspec.structs.replace(name, text=names.get((owner, name.text), name.text))
