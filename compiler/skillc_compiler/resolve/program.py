"""Resolves a library: the vocabulary first, then all skills, then implementations and tasks."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import MappingProxyType

from msgspec import structs

from skillc_compiler.program.program import DefinedRelation, ParsedFile, Program
from skillc_compiler.program.spelling import suggest_fix
from skillc_compiler.program.typed import Implementation, Skill, Task
from skillc_compiler.program.unknown import LostNames, find_lost, limit_candidates
from skillc_compiler.program.use_of_terms import with_use
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.declaring.declarations import (
    Bare,
    FileDeclarations,
    bare_names_in,
    collect_declarations,
    merge_imported,
    prefixes_in,
)
from skillc_compiler.resolve.declaring.terms import extend_vocabulary
from skillc_compiler.resolve.definitions import define_relations
from skillc_compiler.resolve.duplicates import remove_duplicates
from skillc_compiler.resolve.editions import read_older_editions
from skillc_compiler.resolve.homes import Homes, names_by_import
from skillc_compiler.resolve.implementations import resolve_implementation
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.names import KINDS, Kind, Names
from skillc_compiler.resolve.resolver import NOTHING, Findings, Resolver
from skillc_compiler.resolve.scope import FileContext
from skillc_compiler.resolve.skills import names_taken_over, resolve_skill
from skillc_compiler.resolve.tasks import resolve_task
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.query import Memo
from skillc_dsl.source import Source, Span
from skillc_dsl.spelling import did_you_mean
from skillc_rdf.vocabulary.components import components
from skillc_rdf.vocabulary.types import Vocabulary

NO_FILES: Mapping[str, Source] = MappingProxyType({})


def resolve_program(
    read: Sequence[ParsedFile],
    base: Vocabulary,
    name: str,
    scenes: Mapping[str, Individuals],
    memo: Memo | None = None,
    importable: Mapping[str, Source] = NO_FILES,
) -> Outcome[Program]:
    """Return the program of the files; unresolved names are reported and left unknown.

    `scenes` holds the individuals that tasks may name, by task. `importable` are the files that could be imported, by
    the text that does it. `memo` has the declarations of the analysis before, whose meanings are reused if nothing has
    changed that was read for them.
    """
    memo = memo or Memo()
    memo.begin()
    read = tuple(_keep_declarations(unit, memo) for unit in read_older_editions(read))
    bare = bare_names_in(read, base, memo)
    declared = collect_declarations(read, base, bare)
    unique = remove_duplicates(read, declared)
    files = unique.files
    lost = structs.replace(_find_lost(read, base), twice=unique.twice)
    names = _names(files, declared, bare, base, memo, importable)
    vocabulary, defined, of_terms = _terms(files, declared, names, base, memo)
    resolver = Resolver(memo, {path: [found] for path, found in of_terms.items()})
    contexts = _contexts(files, declared, names, vocabulary, memo)
    skills = _skills(files, contexts, resolver)
    tables = memo.table("skills", skills), memo.table("implementations", _implementation_names(files))
    known = {
        path: structs.replace(each, skills=tables[0], implementations=tables[1]) for path, each in contexts.items()
    }
    terms = _first_places(each for found in resolver.found.values() for each in found)
    program = Program(
        name=name,
        vocabulary=memo.same("vocabulary", "named", with_use(vocabulary, terms, skills)),
        files=files,
        skills=skills,
        implementations=tuple(_implementations(files, known, skills, resolver)),
        tasks=tuple(_tasks(files, known, scenes, resolver)),
        used={path: frozenset().union(*(each.used for each in found)) for path, found in resolver.found.items()},
        terms=terms,
        unknown=tuple(
            limit_candidates(name for found in resolver.found.values() for each in found for name in each.unknown)
        ),
        lost=lost,
        defined=defined,
    )
    problems = (problem for found in resolver.found.values() for each in found for problem in each.problems)
    return Outcome(program, (*_headers(files, base), *unique.diagnostics, *problems))


def _keep_declarations(unit: ParsedFile, memo: Memo) -> ParsedFile:
    """Return a file; declarations that have not changed are those of the analysis before."""
    lines = unit.text.split("\n")
    kept = (
        memo.same("written", (d.span, number), (d, lines[d.span.line - 1 : d.span.end_line]))[0]
        for number, d in enumerate(unit.file.declarations)
    )
    return structs.replace(unit, file=structs.replace(unit.file, declarations=tuple(kept)))


def _first_places(found: Iterable[Findings]) -> dict[str, Span]:
    """Return the terms that were looked up, with the first place of each."""
    places: dict[str, Span] = {}
    for each in found:
        for iri, place in each.terms.items():
            places[iri] = min(places.get(iri, place), place)
    return places


def _terms(
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    names: Mapping[str, Names],
    base: Vocabulary,
    memo: Memo,
) -> tuple[Vocabulary, tuple[DefinedRelation, ...], Mapping[str, Findings]]:
    """Return the vocabulary with the terms that the files declare, those that they define, and what else was found."""
    written = tuple((unit, names[unit.file.path]) for unit in map(_without_skills, files) if _changes_terms(unit.file))
    inputs = memo.same("declared terms", "", (base, written))

    def extend() -> tuple[Vocabulary, tuple[DefinedRelation, ...], Mapping[str, Findings]]:
        own = {path: replace(each, problems=[], unknown=[], used=set(), terms={}) for path, each in names.items()}
        vocabulary, defined = define_relations(extend_vocabulary(base, files, declared, own), files, declared, own)
        return vocabulary, defined, {path: Findings.of(each) for path, each in own.items()}

    vocabulary, defined, found = memo.ask("terms", (inputs,), extend)
    return memo.same("vocabulary", "", vocabulary), defined, {path: found.get(path, NOTHING) for path in names}


def _without_skills(unit: ParsedFile) -> ParsedFile:
    """Return what of a file the vocabulary depends on."""
    kinds = s.SkillDeclaration | s.ImplementationDeclaration | s.TaskDeclaration
    terms = tuple(each for each in unit.file.declarations if not isinstance(each, kinds))
    return structs.replace(unit, file=s.File(unit.file.path, unit.file.header, terms), text="")


def _changes_terms(file: s.File) -> bool:
    return bool(file.declarations) or any(isinstance(line, s.Prefix) for line in file.header)


def _contexts(
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    names: Mapping[str, Names],
    vocabulary: Vocabulary,
    memo: Memo,
) -> dict[str, FileContext]:
    """Return the context of each file, in which its own functions and those of its imports are visible."""
    found = {}
    for unit in files:
        here = [declared[unit.file.path], *(declared[path] for _, path in unit.imports)]
        own = sorted({name for there in here for name in there.functions})
        functions = {name: vocabulary.functions[name] for name in own}
        visible = replace(names[unit.file.path], vocabulary=vocabulary, functions=functions)
        known = memo.same("names", unit.file.path, visible)
        found[unit.file.path] = FileContext(known, vocabulary, resolve_condition)
    return found


def _find_lost(files: Sequence[ParsedFile], base: Vocabulary) -> LostNames:
    """Return what may be missing: because of syntax errors, and of files and vocabularies that do not exist."""
    lost = find_lost([unit.file for unit in files])
    return structs.replace(lost, headers=lost.headers | {unit.file.path for unit in files if _lacks_a_file(unit, base)})


def _lacks_a_file(unit: ParsedFile, base: Vocabulary) -> bool:
    """Whether the header names a file or vocabulary that does not exist, and it is not clear which one is meant."""
    found = {line for line, _ in unit.imports}
    used = (name for line in unit.file.header if isinstance(line, s.Use) for name in line.vocabularies)
    return any(isinstance(line, s.Import) and line not in found for line in unit.file.header) or any(
        name.text not in base.prefixes and suggest_fix(name, base.prefixes) is None for name in used
    )


def _names(
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    bare: Mapping[str, Bare],
    base: Vocabulary,
    memo: Memo,
    importable: Mapping[str, Source],
) -> dict[str, Names]:
    known = memo.same("known names", "", _known(declared, base))
    elsewhere = {source.path for source in importable.values()}
    own = {path: there for path, there in sorted(declared.items(), reverse=True) if path not in elsewhere}
    declaring = memo.same("homes", "", {name: path for path, there in own.items() for name in there.names()})
    others = names_by_import(tuple((name, source) for name, source in importable.items() if name not in declared))
    found = {}
    for unit in files:
        here = [declared[unit.file.path], *(declared[path] for _, path in unit.imports)]
        visible_here = {name for there in here for name in there.names()}
        found[unit.file.path] = Names(
            bare=merge_imported(bare[unit.file.path], here, base.later_than(unit.edition)),
            known=known,
            vocabulary=base,
            prefixes=prefixes_in(unit.file, base),
            functions={},
            skills={name for there in here for name in there.skills},
            elsewhere=Homes(declaring, others, visible_here, posixpath.dirname(unit.file.path)),
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


def _skills(files: Sequence[ParsedFile], contexts: Mapping[str, FileContext], resolver: Resolver) -> dict[str, Skill]:
    """Return the skills, in the order of the files; those that `pre of` names are resolved first."""
    written = {
        each.name.text: (contexts[unit.file.path], each)
        for unit in files
        for each in unit.file.declarations
        if isinstance(each, s.SkillDeclaration)
    }
    found: dict[str, Skill] = {}
    table = resolver.memo.table("skills", found)
    needed = {name: names_taken_over(each, written) for name, (_, each) in written.items()}
    for name in (name for group in components(needed) for name in group):
        context, each = structs.replace(written[name][0], skills=table), written[name][1]
        found[name] = resolver.resolve(context, (each,), partial(resolve_skill, written=each))
    return {name: found[name] for name in written}


def _implementation_names(files: Sequence[ParsedFile]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for unit in files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.ImplementationDeclaration):
                found.setdefault(declaration.skill.text, []).append(declaration.name.text)
    return found


def _implementations(
    files: Sequence[ParsedFile], contexts: Mapping[str, FileContext], skills: Mapping[str, Skill], resolver: Resolver
) -> Iterator[Implementation]:
    for unit in files:
        context, lines = contexts[unit.file.path], unit.text.split("\n")
        for each in unit.file.declarations:
            if not isinstance(each, s.ImplementationDeclaration):
                continue
            of = resolver.look_up_skill(context, each.skill)
            if of is not None:
                skill = skills[of]
                resolve = partial(resolve_implementation, written=each, skill=skill, lines=lines)
                yield resolver.resolve(context, (each, skill), resolve)


def _tasks(
    files: Sequence[ParsedFile],
    contexts: Mapping[str, FileContext],
    scenes: Mapping[str, Individuals],
    resolver: Resolver,
) -> Iterator[Task]:
    for unit in files:
        context = contexts[unit.file.path]
        for each in unit.file.declarations:
            if not isinstance(each, s.TaskDeclaration):
                continue
            there = scenes.get(each.name.text)
            known = None if there is None else resolver.individuals(each.name.text, context, there)
            within = structs.replace(context, individuals=known)
            yield resolver.resolve(within, (each, known), partial(resolve_task, written=each))


def _headers(files: Sequence[ParsedFile], base: Vocabulary) -> Iterator[Diagnostic]:
    """Report unknown vocabularies, and prefixes that already denote something else."""
    for line in (line for unit in files for line in unit.file.header):
        match line:
            case s.Use(vocabularies=names):
                yield from (_unknown_vocabulary(each, base) for each in names if each.text not in base.prefixes)
            case s.Prefix(name=name, iri=iri) if base.prefixes.get(name.text, iri) != iri:
                message = f"the prefix `{name.text}` already denotes the vocabulary <{base.prefixes[name.text]}>"
                yield Diagnostic("duplicate-prefix", name.span, message, "choose another prefix")
            case _:
                pass


def _unknown_vocabulary(name: s.Name, base: Vocabulary) -> Diagnostic:
    meant, fix = did_you_mean(name.text, base.prefixes), suggest_fix(name, base.prefixes)
    return Diagnostic("unknown-vocabulary", name.span, f"there is no vocabulary `{name.text}`", meant, fix=fix)
