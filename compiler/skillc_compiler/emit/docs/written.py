"""The source declarations of skills, implementations and tasks, by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from skillc_compiler.program.program import ParsedFile
from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.places import TreeBuilder
from skillc_dsl.source import Source, Span


class WrittenDeclarations(msgspec.Struct, frozen=True):
    """The declarations of a library's files; implementations are keyed `Skill.name`."""

    sources: Mapping[str, Source]
    skills: Mapping[str, s.SkillDeclaration]
    implementations: Mapping[str, s.ImplementationDeclaration]
    tasks: Mapping[str, s.TaskDeclaration]

    def source(self, span: Span) -> Source:
        """Return the source file of a span."""
        return self.sources[span.path]

    def words(self, span: Span) -> str:
        """Return the text of a span, on one line."""
        return TreeBuilder(self.source(span)).written(span)


def collect_declarations(files: Sequence[ParsedFile]) -> WrittenDeclarations:
    """Return the declarations of the files."""
    declared = [each for unit in files for each in unit.file.declarations]
    return WrittenDeclarations(
        {unit.file.path: Source(unit.file.path, unit.text, edition=unit.edition) for unit in files},
        {each.name.text: each for each in declared if isinstance(each, s.SkillDeclaration)},
        {
            f"{each.skill.text}.{each.name.text}": each
            for each in declared
            if isinstance(each, s.ImplementationDeclaration)
        },
        {each.name.text: each for each in declared if isinstance(each, s.TaskDeclaration)},
    )
