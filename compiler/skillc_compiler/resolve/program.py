"""Resolves a library: the vocabulary first, then all skills, then implementations and tasks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from skillc_compiler.program.typed import Implementation, ParsedFile, Program, Skill, Task
from skillc_compiler.program.unknown import LostNames, find_lost
from skillc_compiler.resolve.declarations import (
    FileDeclarations,
    bare_names_in,
    collect_declarations,
    merge_imported,
    prefixes_in,
)
from skillc_compiler.resolve.duplicates import find_twice, remove_duplicates
from skillc_compiler.resolve.implementations import resolve_implementation
from skillc_compiler.resolve.individuals import Individuals, most_specific_classes
from skillc_compiler.resolve.names import KINDS, Kind, Names
from skillc_compiler.resolve.scope import FileContext
from skillc_compiler.resolve.skills import resolve_skill
from skillc_compiler.resolve.spelling import suggest_fix
from skillc_compiler.resolve.tasks import resolve_task
from skillc_compiler.resolve.terms import extend_vocabulary
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.spelling import did_you_mean
from skillc_rdf.vocabulary.types import Vocabulary


def resolve_program(
    read: Sequence[ParsedFile], base: Vocabulary, name: str, scenes: Mapping[str, Individuals]
) -> Outcome[Program]:
    """Return the program of the files; unresolved names are reported and left unknown.

    `scenes` holds the individuals that tasks may name, by task.
    """
    declared = collect_declarations(read, base)
    repeats = remove_duplicates(read, declared)
    files = repeats.value
    lost = replace(_find_lost(read, base), twice=find_twice(read))
    names = _names(files, declared, base)
    vocabulary = extend_vocabulary(base, files, declared, names)
    for visible_names in names.values():
        visible_names.vocabulary = vocabulary
    _make_functions_visible(files, declared, names, vocabulary)
    settings = {path: FileContext(visible_names, vocabulary) for path, visible_names in names.items()}
    skills = _skills(files, settings)
    by_skill = _implementation_names(files)
    settings = {path: replace(st, skills=skills, implementations=by_skill) for path, st in settings.items()}
    program = Program(
        name=name,
        vocabulary=vocabulary,
        files=files,
        skills=skills,
        implementations=tuple(_implementations(files, settings)),
        tasks=tuple(_tasks(files, settings, scenes)),
        used={path: frozenset(visible_names.used) for path, visible_names in names.items()},
        unknown=tuple(unknown for path in names for unknown in names[path].unknown),
        lost=lost,
    )
    problems = (problem for path in names for problem in names[path].problems)
    return Outcome(program, (*_headers(files, base), *repeats.diagnostics, *problems))


def _find_lost(files: Sequence[ParsedFile], base: Vocabulary) -> LostNames:
    """Return what may be missing: because of syntax errors, and of files and vocabularies that do not exist."""
    lost = find_lost(unit.file for unit in files)
    return replace(lost, headers=lost.headers | {unit.file.path for unit in files if _lacks_a_file(unit, base)})


def _lacks_a_file(unit: ParsedFile, base: Vocabulary) -> bool:
    """Whether the header names a file or vocabulary that does not exist, and it is not clear which one is meant."""
    found = {line for line, _ in unit.imports}
    used = (name for line in unit.file.header if isinstance(line, s.Use) for name in line.vocabularies)
    return any(isinstance(line, s.Import) and line not in found for line in unit.file.header) or any(
        name.text not in base.prefixes and suggest_fix(name, base.prefixes) is None for name in used
    )


def _names(files: Sequence[ParsedFile], declared: Mapping[str, FileDeclarations], base: Vocabulary) -> dict[str, Names]:
    known = _known(declared, base)
    homes = {name: path for path, there in sorted(declared.items(), reverse=True) for name in there.names()}
    bare, found = bare_names_in(files, base), {}
    for unit in files:
        here = [declared[unit.file.path], *(declared[path] for _, path in unit.imports)]
        visible_here = {name for there in here for name in there.names()}
        found[unit.file.path] = Names(
            bare=merge_imported(bare[unit.file.path], here),
            known=known,
            vocabulary=base,
            prefixes=prefixes_in(unit.file, base),
            functions={},
            skills={name for there in here for name in there.skills},
            elsewhere={name: path for name, path in homes.items() if name not in visible_here},
        )
    return found


def _known(declared: Mapping[str, FileDeclarations], base: Vocabulary) -> dict[Kind, set[str]]:
    known: dict[Kind, set[str]] = {
        "class": set(base.classes),
        "relation": set(base.relations),
        "property": set(base.properties),
    }
    for there in declared.values():
        for kind in KINDS:
            known[kind].update(there.terms[kind].values())
    return known


def _make_functions_visible(
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    names: Mapping[str, Names],
    vocabulary: Vocabulary,
) -> None:
    for unit in files:
        here = [declared[unit.file.path], *(declared[path] for _, path in unit.imports)]
        own = {name for there in here for name in there.functions}
        names[unit.file.path].functions = {name: vocabulary.functions[name] for name in sorted(own)}


def _skills(files: Sequence[ParsedFile], settings: Mapping[str, FileContext]) -> dict[str, Skill]:
    found: dict[str, Skill] = {}
    for unit in files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.SkillDeclaration):
                found[declaration.name.text] = resolve_skill(settings[unit.file.path], declaration)
    return found


def _implementation_names(files: Sequence[ParsedFile]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for unit in files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.ImplementationDeclaration):
                found.setdefault(declaration.skill.text, []).append(declaration.name.text)
    return found


def _implementations(files: Sequence[ParsedFile], settings: Mapping[str, FileContext]) -> Iterator[Implementation]:
    for unit in files:
        context, lines = settings[unit.file.path], unit.text.split("\n")
        for declaration in unit.file.declarations:
            if not isinstance(declaration, s.ImplementationDeclaration):
                continue
            of = context.names.look_up_skill(declaration.skill)
            if of is not None:
                yield resolve_implementation(context, declaration, context.skills[of], lines)


def _tasks(
    files: Sequence[ParsedFile], settings: Mapping[str, FileContext], scenes: Mapping[str, Individuals]
) -> Iterator[Task]:
    for unit in files:
        context = settings[unit.file.path]
        for declaration in unit.file.declarations:
            if not isinstance(declaration, s.TaskDeclaration):
                continue
            there = scenes.get(declaration.name.text)
            known = None if there is None else most_specific_classes(context.vocabulary, there)
            yield resolve_task(replace(context, individuals=known), declaration)


def _headers(files: Sequence[ParsedFile], base: Vocabulary) -> Iterator[Diagnostic]:
    """Report unknown vocabularies, and prefixes that already denote something else."""
    for unit in files:
        for line in unit.file.header:
            match line:
                case s.Use(vocabularies=vocabularies):
                    for name in (n for n in vocabularies if n.text not in base.prefixes):
                        yield Diagnostic(
                            "unknown-vocabulary",
                            name.span,
                            f"there is no vocabulary `{name.text}`",
                            did_you_mean(name.text, base.prefixes),
                            fix=suggest_fix(name, base.prefixes),
                        )
                case s.Prefix(name=name, iri=iri) if base.prefixes.get(name.text, iri) != iri:
                    yield Diagnostic(
                        "duplicate-prefix",
                        name.span,
                        f"the prefix `{name.text}` already denotes the vocabulary <{base.prefixes[name.text]}>",
                        "choose another prefix",
                    )
                case _:
                    pass
