"""Links between pages, all relative, so that the reference works from any folder and without a server."""

from __future__ import annotations

import re
from collections.abc import Iterable

import msgspec
from markupsafe import Markup

from skillc_dsl.position import Position
from skillc_model.format_type import format_type
from skillc_rdf.vocabulary.types import ClassType, ListType, ValueType, Vocabulary, local_name

_NAME = re.compile(r"[A-Za-z_][\w-]*(?::[A-Za-z_][\w-]*)?")


class LinkWriter(msgspec.Struct, frozen=True):
    """Writes the links of one page; `root` is the relative path from it to the top: "", "../", "../../", ..

    `terms` are the IRIs and functions that are on the terms page, `sources` the files that have a page.
    """

    root: str
    vocabulary: Vocabulary
    skills: frozenset[str]
    terms: frozenset[str]
    sources: frozenset[str]

    def page(self, skill: str) -> str | None:
        """Return the address of a skill's page; None if it has no page."""
        return f"{self.root}skill/{skill}.html" if skill in self.skills else None

    def skill(self, name: str) -> Markup:
        """Return a link to a skill."""
        href = self.page(name)
        return _link(href, name) if href else Markup("<code>{}</code>").format(name)

    def source(self, place: Position) -> Markup:
        """Return a link to a line of a source file, or plain text if the file has no page."""
        if place.path not in self.sources:
            return Markup("<code>{}</code>").format(place)
        return _link(f"{self.root}source/{place.path}.html#L{place.line}", str(place))

    def line(self, place: Position) -> Markup:
        """Return a link to a line of a source file, shown without the name of the file."""
        return Markup('<a href="{}source/{}.html#L{}">line {}</a>').format(
            self.root, place.path, place.line, place.line
        )

    def term(self, name: str) -> Markup:
        """Return a link to a term by its IRI, or to a function by its name."""
        return self._term(name, self.vocabulary.short(name))

    def type(self, type_: ValueType) -> Markup:
        """Return a type with a link to its class."""
        match type_:
            case ClassType(iri=iri):
                return self.term(iri)
            case ListType(element=element):
                return Markup("[{}]").format(self.type(element))
            case _:
                return Markup("<code>{}</code>").format(format_type(type_, self.vocabulary))

    def code(self, text: str, mentioned: Iterable[str]) -> Markup:
        """Return source text as code with links to the terms in `mentioned`."""
        known = {written: each for each in mentioned for written in (local_name(each), self.vocabulary.short(each))}
        parts, end = [], 0
        for found in _NAME.finditer(text):
            if found.group() in known and known[found.group()] in self.terms:
                parts += [Markup.escape(text[end : found.start()]), self._bare(known[found.group()], found.group())]
                end = found.end()
        return Markup("<code>{}</code>").format(Markup("").join((*parts, Markup.escape(text[end:]))))

    def _term(self, name: str, shown: str) -> Markup:
        return Markup("<code>{}</code>").format(self._bare(name, shown) if name in self.terms else shown)

    def _bare(self, name: str, shown: str) -> Markup:
        return Markup('<a href="{}terms.html#{}">{}</a>').format(self.root, make_anchor(name, self.vocabulary), shown)


def make_anchor(name: str, vocabulary: Vocabulary) -> str:
    """Return the anchor of a term on the terms page."""
    return re.sub(r"[^\w-]", "-", vocabulary.short(name))


def _link(href: str, text: str) -> Markup:
    return Markup('<a href="{}"><code>{}</code></a>').format(href, text)
