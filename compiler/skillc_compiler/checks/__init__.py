"""The checks of a resolved program, one per file: each file in this folder is found as a check.

Each has `NAMES`, the diagnostics that it reports, `NEEDS`, what has to be free of errors for it to be right, `READS`,
what it depends on, and `check`. manual/NAME.md explains each diagnostic.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Protocol, TypeAlias, cast

from skillc_compiler.analysis.proof import ProofMemo, prove
from skillc_compiler.program.causes import group_by_cause
from skillc_compiler.program.marks import Marks, Need
from skillc_compiler.program.memo import Memo
from skillc_compiler.program.parts import Part, Reads, only_in, parts_of
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic

FoundBy: TypeAlias = Mapping[str, Sequence[Diagnostic]]
"""The problems that each check has found, by the name of its module."""


class CheckModule(Protocol):
    """A module in this folder."""

    __name__: str
    NAMES: tuple[str, ...]
    NEEDS: Need
    READS: Reads

    def check(self, of: Any, /) -> Iterator[Diagnostic]:
        """Yield the problems of the proofs if it reads proofs, else of the program, which may be one declaration."""
        ...


@dataclass
class CheckMemo:
    """What the checks have found in the declarations of the last analysis, and the proofs of its bodies."""

    parts: Memo[FoundBy] = field(default_factory=Memo)
    proofs: ProofMemo = field(default_factory=ProofMemo)


@cache
def load_checks() -> tuple[CheckModule, ...]:
    """Return all checks, in order of their file names."""
    names = sorted(module.name for module in iter_modules(__path__))
    return tuple(cast(CheckModule, import_module(f"{__name__}.{name}")) for name in names)


def find_all(program: Program, memo: CheckMemo, paths: Collection[str] | None = None) -> FoundBy:
    """Return what each check finds; a declaration is checked again only if what its checks read has changed.

    With `paths`, only the declarations in these files are complete, and only these are checked.
    """
    proofs = prove(program, memo.proofs, paths)
    found: dict[str, list[Diagnostic]] = {check.__name__: [] for check in load_checks()}
    memo.parts.begin()
    for part in parts_of(program, paths):
        for name, problems in memo.parts.recall(part.of, partial(_check_part, part)).items():
            found[name] += problems
    chosen = program if paths is None else only_in(program, paths)
    for check in load_checks():
        match check.READS:
            case Reads.PYTHON:
                found[check.__name__] += check.check(chosen)
            case Reads.PROOFS:
                found[check.__name__] += check.check(proofs)
            case Reads.NEIGHBOURS:
                found[check.__name__] += (
                    one for one in check.check(program) if paths is None or one.span.path in paths
                )
            case Reads.LIBRARY if paths is None:
                found[check.__name__] += check.check(program)
            case _:
                pass
    return found


def _check_part(part: Part) -> FoundBy:
    program = part.program()
    checks = (each for each in load_checks() if each.READS is Reads.DECLARATION)
    found = {each.__name__: tuple(each.check(program)) for each in checks}
    return {name: problems for name, problems in found.items() if problems}


def run_checks(
    program: Program,
    errors: Iterable[Diagnostic],
    resolving: Sequence[Diagnostic] = (),
    memo: CheckMemo | None = None,
    paths: Collection[str] | None = None,
) -> Iterator[Diagnostic]:
    """Yield the problems that any check finds and that are independent of known errors, together with `resolving`.

    Checks that need least come first; what they find is known to the others. `resolving` are problems with names and
    types that were found before. With `paths`, only the declarations in these files are checked.
    """
    everything = find_all(program, memo or CheckMemo(), paths)
    marks = Marks(program, (*errors, *resolving))
    for need in Need:
        checks = [one for one in load_checks() if need == one.NEEDS]
        allowed = [problem for one in checks for problem in everything[one.__name__] if marks.allow(need, problem)]
        earlier = resolving if need == Need.NAMES else ()
        found = group_by_cause((*earlier, *allowed), program)
        yield from found
        marks.add(found)
