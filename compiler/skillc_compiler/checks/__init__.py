"""The checks of a resolved program, one per file: each file in this folder is found as a check.

Each has `NAMES`, the diagnostics that it reports, `NEEDS`, what has to be free of errors for it to be right, `READS`,
what it depends on, and `check`. manual/NAME.md explains each diagnostic.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache, partial
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, Protocol, TypeAlias, cast

from skillc_compiler.analysis.proof import Prover, prove
from skillc_compiler.program.causes import group_by_cause
from skillc_compiler.program.marks import Marks, Need
from skillc_compiler.program.parts import Part, Reads, families_of, resolved_parts, split_by_file, written_parts
from skillc_compiler.program.program import Program
from skillc_compiler.program.slices import digest_reads
from skillc_compiler.python.targets import NamedPython, Targets
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo

FoundBy: TypeAlias = Mapping[str, Sequence[Diagnostic]]
"""The problems that each check has found, by the name of its module."""


class CheckModule(Protocol):
    """A module in this folder."""

    __name__: str
    NAMES: tuple[str, ...]
    NEEDS: Need
    READS: Reads

    def check(self, of: Any, /) -> Iterator[Diagnostic]:
        """Yield the problems of the proofs if it reads proofs, else of the program, which may be one declaration.

        A check that reads Python gets the program with what reads it.
        """
        ...


@cache
def load_checks() -> tuple[CheckModule, ...]:
    """Return all checks, in order of their file names."""
    names = sorted(module.name for module in iter_modules(__path__))
    return tuple(cast(CheckModule, import_module(f"{__name__}.{name}")) for name in names)


def find_all(program: Program, memo: Memo, paths: Collection[str] | None = None) -> FoundBy:
    """Return what each check finds; a declaration is checked again only if what its checks read has changed.

    With `paths`, only the declarations in these files are complete, and only these are checked.
    """
    found: dict[str, list[Diagnostic]] = {check.__name__: [] for check in load_checks()}
    for in_file in _find_in_files(program, memo, paths):
        for name, problems in in_file.items():
            found[name] += problems
    for part in families_of(program, paths):
        for name, problems in memo.ask("family", part.of, partial(_check_part, part, Reads.FAMILY)).items():
            found[name] += (each for each in problems if paths is None or each.span.path in paths)
    for check in load_checks():
        if check.READS is Reads.NEIGHBOURS:
            found[check.__name__] += (each for each in check.check(program) if paths is None or each.span.path in paths)
        elif check.READS is Reads.LIBRARY and paths is None:
            found[check.__name__] += check.check(program)
    return found


def _find_in_files(program: Program, memo: Memo, paths: Collection[str] | None) -> Iterator[FoundBy]:
    """Yield what the checks of declarations, of Python and of proofs find in each file, or in each of some."""
    prover, targets = Prover(program, memo), memo.ask("targets", (), Targets)
    targets.refresh()
    read = digest_reads(program, memo) if memo.store is not None else {}
    for path, one in split_by_file(program).items():
        find = partial(_find_in_file, one, memo, prover, targets)
        if paths is None or path in paths:
            yield memo.recall("findings", (memo.around, read[path]), find) if path in read else find()


def _find_in_file(one: Program, memo: Memo, prover: Prover, targets: Targets) -> FoundBy:
    found: dict[str, list[Diagnostic]] = defaultdict(list)
    for reads, parts in ((Reads.WRITTEN, written_parts(one)), (Reads.DECLARATION, resolved_parts(one))):
        for part in parts:
            for name, problems in memo.ask("declaration checks", part.of, partial(_check_part, part, reads)).items():
                found[name] += problems
    proofs, python = prove(one, prover), NamedPython(one, targets)
    for check in load_checks():
        if check.READS in (Reads.PROOFS, Reads.PYTHON):
            found[check.__name__] += check.check(proofs if check.READS is Reads.PROOFS else python)
    return {name: tuple(problems) for name, problems in found.items() if problems}


def _check_part(part: Part, reads: Reads) -> FoundBy:
    program = part.program()
    checks = (each for each in load_checks() if each.READS is reads)
    found = {each.__name__: tuple(each.check(program)) for each in checks}
    return {name: problems for name, problems in found.items() if problems}


def run_checks(
    program: Program,
    errors: Iterable[Diagnostic],
    resolving: Sequence[Diagnostic] = (),
    memo: Memo | None = None,
    paths: Collection[str] | None = None,
) -> Iterator[Diagnostic]:
    """Yield the problems that any check finds and that are independent of known errors, together with `resolving`.

    Checks that need least come first; what they find is known to the others. `resolving` are problems with names and
    types that were found before. With `paths`, only the declarations in these files are checked.
    """
    everything = find_all(program, memo or Memo(), paths)
    marks = Marks(program, (*errors, *resolving))
    for need in Need:
        checks = [one for one in load_checks() if need == one.NEEDS]
        allowed = [problem for one in checks for problem in everything[one.__name__] if marks.allow(need, problem)]
        earlier = resolving if need == Need.NAMES else ()
        found = group_by_cause((*earlier, *allowed), program)
        yield from found
        marks.add(found)
