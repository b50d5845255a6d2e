"""The static HTML reference: an index, a page for each skill and each source file, the tasks, the terms.

The output is deterministic and loads nothing from other servers.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from functools import cache
from importlib.resources import files
from pathlib import Path

import msgspec
from jinja2 import Environment
from markupsafe import Markup

from skillc_compiler.emit.docs import prose
from skillc_compiler.emit.docs.linking import LinkWriter, make_anchor
from skillc_compiler.emit.docs.listing import format_listing
from skillc_compiler.emit.docs.skill_page import skill_page
from skillc_compiler.emit.docs.terms_page import shown_terms, term_groups
from skillc_compiler.emit.docs.written import WrittenDeclarations, collect_declarations
from skillc_compiler.emit.picture import svg
from skillc_compiler.emit.picture.drawing import draw_task
from skillc_compiler.program.program import ParsedFile
from skillc_model.skills import Skill, SkillLibrary, Task
from skillc_model.templates import open_templates

ENTRIES = "[/* entries */]"
"""Placeholder for the entries in the script of the search box."""
MARK = "Made by skillc doc from the library"
"""The text of the first line of each page."""


class SiteContents(msgspec.Struct, frozen=True):
    """Data shared by all pages: the library, its declarations, its own and imported skills, the terms shown."""

    library: SkillLibrary
    declared: WrittenDeclarations
    own: tuple[Skill, ...]
    imported: tuple[Skill, ...]
    terms: frozenset[str]

    def links(self, path: str) -> LinkWriter:
        """Return the writer of links for the page at `path`."""
        sources, skills = frozenset(self.declared.sources), frozenset(self.library.skills)
        return LinkWriter("../" * path.count("/"), self.library.vocabulary, skills, self.terms, sources)

    def page(self, path: str, template: str, title: str, **values: object) -> str:
        """Return the page at `path`."""
        links = self.links(path)
        shared = {"title": title, "root": links.root, "contents": self, "links": links, "prose": prose}
        return _environment().get_template(template).render(shared | values)

    @property
    def mark(self) -> str:
        """The text of the first line of each page."""
        return f"{MARK} {self.library.name}, sha256 {self.library.hash}"


class ShownTask(msgspec.Struct, frozen=True):
    """A task with its picture."""

    task: Task
    doc: Markup
    place: Markup
    picture: Markup


def make_site(library: SkillLibrary, files_read: Sequence[ParsedFile]) -> dict[str, str]:
    """Return the text of each file of the reference by its path, with `/` as separator.

    `files_read` are the files that the library was compiled from.
    """
    contents = _contents(library, files_read)
    pages = {
        "index.html": contents.page("index.html", "index.html.j2", library.name),
        "tasks.html": contents.page("tasks.html", "tasks.html.j2", "Tasks", tasks=_tasks(contents)),
        "terms.html": contents.page("terms.html", "terms.html.j2", "Terms", groups=_terms(contents)),
        "style.css": _text("style.css") + svg.STYLE,
        "search.js": _search_script(_text("search.js"), library, contents.terms),
    }
    return dict(sorted((pages | _skills(contents) | _sources(contents)).items()))


def _contents(library: SkillLibrary, files_read: Sequence[ParsedFile]) -> SiteContents:
    own = {unit.file.path for unit in files_read if unit.library == library.name}
    skills = tuple(skill for _, skill in sorted(library.skills.items()))
    return SiteContents(
        library,
        collect_declarations(files_read),
        tuple(skill for skill in skills if skill.source.path in own),
        tuple(skill for skill in skills if skill.source.path not in own),
        shown_terms(library),
    )


def _skills(contents: SiteContents) -> dict[str, str]:
    pages = {}
    for skill in (*contents.own, *contents.imported):
        path = f"skill/{skill.name}.html"
        shown = skill_page(skill, contents.library, contents.declared, contents.links(path))
        pages[path] = contents.page(path, "skill.html.j2", skill.name, skill=shown)
    return pages


def _sources(contents: SiteContents) -> dict[str, str]:
    pages = {}
    for name, source in contents.declared.sources.items():
        path = f"source/{name}.html"
        pages[path] = contents.page(path, "source.html.j2", name, lines=format_listing(source))
    return pages


def _tasks(contents: SiteContents) -> list[ShownTask]:
    links, declared = contents.links("tasks.html"), contents.declared
    shown = []
    for name, task in sorted(contents.library.tasks.items()):
        tree = declared.tasks[name]
        picture = Markup(svg.draw(draw_task(tree, declared.source(tree.span)), links.page))
        shown.append(ShownTask(task, prose.block(task.doc), links.source(task.source), picture))
    return shown


def _terms(contents: SiteContents) -> object:
    return term_groups(contents.library, contents.links("terms.html"))


def _text(name: str) -> str:
    return (files("skillc_compiler.emit.docs") / "templates" / name).read_text("utf-8")


@cache
def _environment() -> Environment:
    return open_templates(Path(__file__).parent / "templates", is_html=True)


def _search_script(template: str, library: SkillLibrary, terms: frozenset[str]) -> str:
    """Return the script with an entry for each skill, task and term: its name, its kind, its page."""
    entries = json.dumps(sorted(_search_entries(library, terms)), ensure_ascii=False, indent=0)
    return template.replace(ENTRIES, entries)


def _search_entries(library: SkillLibrary, terms: frozenset[str]) -> Iterator[tuple[str, str, str]]:
    vocabulary = library.vocabulary
    yield from ((name, "skill", f"skill/{name}.html") for name in library.skills)
    yield from ((name, "task", f"tasks.html#{name}") for name in library.tasks)
    kinds = (
        ("class", vocabulary.classes),
        ("relation", vocabulary.relations),
        ("property", vocabulary.properties),
        ("function", vocabulary.functions),
    )
    for kind, table in kinds:
        for name in terms & table.keys():
            yield vocabulary.short(name), kind, f"terms.html#{make_anchor(name, vocabulary)}"
