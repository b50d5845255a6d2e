"""Relations that a library defines by conditions: what each means, and the facts that it follows from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from msgspec import structs

from skillc_compiler.program.program import DefinedRelation, ParsedFile
from skillc_compiler.program.types import UNKNOWN, Thing
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.declaring.declarations import FileDeclarations
from skillc_compiler.resolve.names import Names
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_dsl import syntax as s
from skillc_model.conditions import Condition, Holds, Invoke, Variable
from skillc_model.read_write import terms_read
from skillc_model.rewriting import fold
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.components import components
from skillc_rdf.vocabulary.types import Definition, Vocabulary

EVALUATOR = "skillc_runtime.world.eval.definitions:DefinedRelation"
"""What computes a defined relation from facts."""


def define_relations(
    vocabulary: Vocabulary,
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    names: Mapping[str, Names],
) -> tuple[Vocabulary, tuple[DefinedRelation, ...]]:
    """Return the vocabulary with the definitions in the files, and these as they are written.

    Problems are added to the files' names. Of several definitions of a relation, the first one counts, and none whose
    classes are unknown.
    """
    found = tuple(_resolve(vocabulary, files, declared, names))
    if not found:
        return vocabulary, ()
    first = {each.iri: each for each in reversed(found)}
    groups = _find_groups(first)
    definitions = {
        iri: Definition(
            subject=Variable(each.subject.text),
            object=Variable(each.object.text),
            condition=fold(each.condition.meaning),
            text=each.text,
            group=groups[iri],
        )
        for iri, each in sorted(first.items())
        if len(vocabulary.relations[iri].signatures) == 1
    }
    bases = _find_bases(first, vocabulary)
    relations = dict(vocabulary.relations)
    for iri in definitions:
        relations[iri] = structs.replace(relations[iri], computed_by=EVALUATOR, computed_from=bases[iri])
    return structs.replace(vocabulary, relations=relations, definitions=definitions), found


def _resolve(
    vocabulary: Vocabulary,
    files: Sequence[ParsedFile],
    declared: Mapping[str, FileDeclarations],
    names: Mapping[str, Names],
) -> Iterator[DefinedRelation]:
    for unit in files:
        path = unit.file.path
        here = [declared[path], *(declared[other] for _, other in unit.imports)]
        functions = {name: vocabulary.functions[name] for there in here for name in there.functions}
        visible = replace(names[path], vocabulary=vocabulary, functions=functions)
        context = FileContext(visible, vocabulary, resolve_condition)
        for written in unit.file.declarations:
            if isinstance(written, s.RelationDeclaration) and written.definition is not None:
                iri = declared[path].terms["relation"][written.name.text]
                yield _resolve_one(context, iri, written, written.definition)


def _resolve_one(
    context: FileContext, iri: str, written: s.RelationDeclaration, definition: s.Definition
) -> DefinedRelation:
    scope = Scope(f"the relation `{written.name.text}`")
    signature = next(iter(context.vocabulary.relations[iri].signatures), None)
    classes = (signature.domain, signature.range) if signature else (None, None)
    for name, cls in zip((definition.subject, definition.object), classes, strict=True):
        scope = context.bind(scope, name, LocalName(Thing(cls) if cls else UNKNOWN, "variable", name.span))
    return DefinedRelation(
        iri=iri,
        subject=definition.subject,
        object=definition.object,
        condition=resolve_condition(context, scope, definition.condition),
        text=definition.text,
        name_span=written.name.span,
        span=written.span,
    )


def _find_groups(defined: Mapping[str, DefinedRelation]) -> dict[str, tuple[str, ...]]:
    """Return the relations that lead back to each: those that are defined by one another."""
    edges = {iri: [each for each in sorted(_relations_in(one)) if each in defined] for iri, one in defined.items()}
    found: dict[str, tuple[str, ...]] = {}
    for group in components(edges):
        recursive = len(group) > 1 or group[0] in edges[group[0]]
        found |= dict.fromkeys(group, tuple(sorted(group)) if recursive else ())
    return found


def _find_bases(defined: Mapping[str, DefinedRelation], vocabulary: Vocabulary) -> dict[str, tuple[str, ...]]:
    """Return the relations and properties from which each relation follows; none if they are not known."""
    return {iri: tuple(sorted(_bases_of(iri, defined, vocabulary) or ())) for iri in defined}


def _bases_of(start: str, defined: Mapping[str, DefinedRelation], vocabulary: Vocabulary) -> set[str] | None:
    bases, seen, waiting = set[str](), {start}, [start]
    while waiting:
        condition: Condition = defined[waiting.pop()].condition.meaning
        if any(isinstance(each, Invoke) for each in walk(condition)):
            return None
        for term in terms_read(condition) - seen:
            seen.add(term)
            if term in defined:
                waiting.append(term)
            elif not vocabulary.is_computed(term):
                bases |= {term, *(each.relation for each in vocabulary.closure.canonical_sources.get(term, ()))}
            elif term in vocabulary.relations and vocabulary.relations[term].computed_from:
                bases |= {*vocabulary.relations[term].computed_from}
            else:
                return None
    return bases


def _relations_in(one: DefinedRelation) -> set[str]:
    return {each.relation for each in walk(one.condition.meaning) if isinstance(each, Holds)}
