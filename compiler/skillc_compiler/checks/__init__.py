"""The checks of a resolved program, one per file: each file in this folder is found as a check.

Each has `NAMES`, the diagnostics that it reports, `NEEDS`, what has to be free of errors for it to be right, `READS`,
what it depends on, and `check`. manual/NAME.md explains each diagnostic.
"""

from __future__ import annotations

from collections import defaultdict
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
from skillc_compiler.program.parts import Part, Reads, families_of, only_in, resolved_parts, written_parts
from skillc_compiler.program.typed import Program
from skillc_compiler.python.targets import NamedPython, Targets
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
        """Yield the problems of the proofs if it reads proofs, else of the program, which may be one declaration.

        A check that reads Python gets the program with what reads it.
        """
        ...


class FileFindings(Protocol):
    """What checks have found in files, where everything that they read for it is the same."""

    def look_up(self, program: Program) -> Mapping[str, FoundBy]:
        """Return what is known of the files of a program, by path."""
        ...

    def keep(self, found: Mapping[str, FoundBy]) -> None:
        """Keep what was found in the files of the program that was looked up last."""
        ...


@dataclass
class CheckMemo:
    """What the checks have found in the declarations and families of the last analysis, and the proofs of its bodies.

    `files` knows what others have found in whole files.
    """

    parts: Memo[FoundBy] = field(default_factory=Memo)
    families: Memo[FoundBy] = field(default_factory=Memo)
    proofs: ProofMemo = field(default_factory=ProofMemo)
    targets: Targets = field(default_factory=Targets)
    files: FileFindings | None = None


@cache
def load_checks() -> tuple[CheckModule, ...]:
    """Return all checks, in order of their file names."""
    names = sorted(module.name for module in iter_modules(__path__))
    return tuple(cast(CheckModule, import_module(f"{__name__}.{name}")) for name in names)


def find_all(program: Program, memo: CheckMemo, paths: Collection[str] | None = None) -> FoundBy:
    """Return what each check finds; a declaration is checked again only if what its checks read has changed.

    With `paths`, only the declarations in these files are complete, and only these are checked.
    """
    chosen = [path for path in _paths(program) if paths is None or path in paths]
    known = memo.files.look_up(program) if memo.files else {}
    in_files = {**known, **_find_in_files(program, memo, [path for path in chosen if path not in known])}
    if memo.files:
        memo.files.keep(in_files)
    found: dict[str, list[Diagnostic]] = {check.__name__: [] for check in load_checks()}
    for path in chosen:
        for name, problems in in_files[path].items():
            found[name] += problems
    memo.families.begin()
    for part in families_of(program, paths):
        for name, problems in memo.families.recall(part.of, partial(_check_part, part, Reads.FAMILY)).items():
            found[name] += (each for each in problems if paths is None or each.span.path in paths)
    for check in load_checks():
        if check.READS is Reads.NEIGHBOURS:
            found[check.__name__] += (each for each in check.check(program) if paths is None or each.span.path in paths)
        elif check.READS is Reads.LIBRARY and paths is None:
            found[check.__name__] += check.check(program)
    return found


def _find_in_files(program: Program, memo: CheckMemo, paths: Collection[str]) -> Mapping[str, FoundBy]:
    """Return what the checks of declarations, of Python and of proofs find in some files, by path."""
    found: dict[str, dict[str, list[Diagnostic]]] = {path: defaultdict(list) for path in paths}
    memo.parts.begin()
    for reads, parts in ((Reads.WRITTEN, written_parts), (Reads.DECLARATION, resolved_parts)):
        for part in parts(program, paths):
            for name, problems in memo.parts.recall(part.of, partial(_check_part, part, reads)).items():
                found[part.path][name] += problems
    memo.targets.refresh()
    proofs, chosen = prove(program, memo.proofs, paths), NamedPython(only_in(program, paths), memo.targets)
    for check in load_checks():
        if check.READS in (Reads.PROOFS, Reads.PYTHON):
            for problem in check.check(proofs if check.READS is Reads.PROOFS else chosen):
                found[problem.span.path][check.__name__].append(problem)
    return {path: {name: tuple(problems) for name, problems in each.items()} for path, each in found.items()}


def _paths(program: Program) -> Iterable[str]:
    """Return the paths of all files, and of what is in no file."""
    spans = (each.span for part in (program.skills.values(), program.implementations, program.tasks) for each in part)
    return dict.fromkeys((*(unit.file.path for unit in program.files), *(span.path for span in spans)))


def _check_part(part: Part, reads: Reads) -> FoundBy:
    program = part.program()
    checks = (each for each in load_checks() if each.READS is reads)
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
