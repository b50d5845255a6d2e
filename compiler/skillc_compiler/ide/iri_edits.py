"""Renames an IRI: where it is named in Turtle, and with its prefix in skills and goals."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

import msgspec

from skillc_compiler.ide.project_names import SCENE, ProjectNames, symbol_of
from skillc_compiler.ide.symbols import ChoiceSymbol, IndividualSymbol, Symbol, TermSymbol
from skillc_dsl.diagnostics import Fix
from skillc_dsl.edits import apply_fixes
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.names import find_names
from skillc_rdf.vocabulary.types import local_name


class IriChange(msgspec.Struct, frozen=True):
    """The new IRIs by the old ones: that of a symbol, and with a class those of its values."""

    symbol: Symbol
    new: Mapping[str, str]

    def edits(self, names: ProjectNames) -> Iterator[Fix]:
        """Yield the edits in Turtle, and those of values with a prefix, whose class is renamed, in skills and goals."""
        for path, text in names.turtle.items():
            lines = Lines(path, text)
            for name in find_names(text, SCENE):
                if name.iri in self.new:
                    start, end, written = name.rewrite(local_name(name.iri), local_name(self.new[name.iri]))
                    yield Fix(lines.place(start, end), written, "rename")
        if isinstance(self.symbol, TermSymbol):
            yield from self._of_values(names, self.symbol.iri)

    def _of_values(self, names: ProjectNames, cls: str) -> Iterator[Fix]:
        for value in names.analysis.program.vocabulary.enumerations.get(cls, ()):
            for occurrence in names.of(symbol_of(names.analysis.program.vocabulary, value)):
                local, span = local_name(value), occurrence.span
                if span.path not in names.turtle and span.end_column - span.column > len(local):
                    place = span._replace(column=span.end_column - len(local))
                    yield Fix(place, local_name(self.new[value]), "rename")


def rename_iri(names: ProjectNames, symbol: Symbol, new: str) -> IriChange | None:
    """Return the change of the IRI of a symbol; None for a symbol that has none."""
    match symbol:
        case TermSymbol(iri=iri):
            renamed = iri.removesuffix(local_name(iri)) + new
            values = names.analysis.program.vocabulary.enumerations.get(iri, ())
            own = {each: renamed + each.removeprefix(iri) for each in values if each.startswith(f"{iri}-")}
            return IriChange(symbol, {iri: renamed, **own})
        case ChoiceSymbol(text=text, iri=iri):
            return IriChange(symbol, {iri: iri.removesuffix(text) + new})
        case IndividualSymbol(iri=iri):
            return IriChange(symbol, {iri: iri.removesuffix(local_name(iri)) + new})
        case _:
            return None


def refuse_iri(names: ProjectNames, change: IriChange) -> str | None:
    """Return why an IRI cannot be changed; None if it can."""
    vocabulary = names.analysis.program.vocabulary
    old = local_name(next(iter(change.new)))
    for iri in change.new.values():
        taken = names.of(symbol_of(vocabulary, iri))
        if taken or iri in {*vocabulary.terms, *vocabulary.aliases}:
            where = f", in {taken[0].span.path}" if taken else ""
            return f"there is a `{local_name(iri)}` already{where}"
    if other := next((each for each, term in vocabulary.aliases.items() if term in change.new), None):
        return f"`{old}` has another name in the ontology, `{local_name(other)}`"
    return _refuse_places(names, change, old) or _refuse_spelling(names, change)


def _refuse_places(names: ProjectNames, change: IriChange, old: str) -> str | None:
    """Return which text that is not edited names what is renamed."""
    edited = {*names.analysis.library.sources, *names.turtle, *(each.path for each in names.goals)}
    vocabulary = names.analysis.program.vocabulary
    for each in (place for iri in change.new for place in names.of(symbol_of(vocabulary, iri))):
        if each.span.path not in edited:
            return f"`{old}` is also named in {each.span.path}, outside of the project"
    bare = [each for each in names.of(ChoiceSymbol(old.rpartition("-")[2])) if each.span.path not in names.turtle]
    goals = {each.path for each in names.goals}
    if isinstance(change.symbol, ChoiceSymbol) and any(each.span.path in goals for each in bare):
        return f"`{old}` may be meant in a goal of the manifest: write it with its prefix there first"
    word = re.compile(rf"(?<![\w-]){re.escape(old)}(?![\w-])")
    unread = next((each.path for each in names.unread_goals if word.search(each.text)), None)
    if unread is not None:
        return f"`{old}` is also named in a goal of {unread} that is not read: rename it there first"
    for path, fixed in names.fixed.items():
        if word.search(fixed.text):
            return f"`{old}` is also named in {path}, {fixed.reason}"
    return None


def _refuse_spelling(names: ProjectNames, change: IriChange) -> str | None:
    """Return whether the names that result cannot be written in Turtle: those after the edits are not those meant."""
    edits = list(change.edits(names))
    for path, text in names.turtle.items():
        meant = [change.new.get(each.iri, each.iri) for each in find_names(text, SCENE)]
        after = apply_fixes(text, [each for each in edits if each.span.path == path])
        if [each.iri for each in find_names(after, SCENE)] != meant:
            return f"{path} cannot write this name"
    return None
