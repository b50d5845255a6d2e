"""Parses terms that are at most a few tokens: IRIs, prefixed names, blank nodes and literals."""

from __future__ import annotations

from collections.abc import Mapping

import pyoxigraph as ox

from skillc_rdf.turtle.cursor import Cursor, extent
from skillc_rdf.turtle.messages import SyntaxMessage, explain_invalid_term, explain_no_object, quote_token
from skillc_rdf.turtle.prefixes import Prefixes
from skillc_rdf.turtle.statements import Extent, Node
from skillc_rdf.turtle.terms import XSD, TermError, iri_of, local_of, make_node, number_of, text_of
from skillc_rdf.turtle.tokens import Token

ParsedTerm = tuple[Node | None, Extent]
"""A term with its extent; None for a wrong one, which has been reported."""


class TermParser:
    """The prefixes, base and blank node labels of a text, by which terms are parsed.

    `doubtful` are the IRIs in parts of the text that could not be parsed.
    """

    def __init__(self, cursor: Cursor, base: str, known: Mapping[str, str]) -> None:
        self.prefixes = Prefixes(known, cursor.lines)
        self.doubtful: set[str] = set()
        self._cursor = cursor
        self._base = base
        self._blank: dict[str, ox.BlankNode] = {}

    def declare(self, name: Token | None, value: Token) -> None:
        """Add the declaration of a prefix, or of the base if there is no name."""
        iri = self._iri(value)
        if iri is not None and name is not None:
            self.prefixes.declare(name, value, iri)
        elif iri is not None:
            self._base = iri

    def give_up(self, name: Token | None) -> None:
        """Note that the declaration of a prefix (or of the base, without a name) could not be parsed."""
        if name is not None:
            self.prefixes.give_up(name.text.removesuffix(":"))

    def iri(self, token: Token) -> str | None:
        """Return the IRI of an `iri` or a `name`; None if it is wrong, which is reported."""
        return self._name(token) if token.kind == "name" else self._iri(token)

    def term(self, token: Token, predicate: Token | None = None) -> ParsedTerm:
        """Return the term that begins with a token; `predicate` is the one before it, for messages."""
        match token.kind:
            case "iri" | "name":
                return self._named(token), extent(token)
            case "blank":
                return self._blank.setdefault(token.text, ox.BlankNode()), extent(token)
            case "number":
                return number_of(token), extent(token)
            case "text":
                return self._text(token)
            case "word" if token.text in ("true", "false"):
                return ox.Literal(token.text, datatype=make_node(f"{XSD}boolean")), extent(token)
        wrong = explain_invalid_term(token, self._cursor.names)
        self._cursor.report(token, wrong or explain_no_object(token, predicate or token))
        return None, extent(token)

    def doubt(self, token: Token) -> None:
        """Note a name in a part of the text that could not be parsed."""
        if token.kind == "name":
            prefix, local = local_of(token)
            if not local:
                self.prefixes.give_up(prefix)
            self.doubtful.add((self.prefixes.base_of(prefix, token) or "") + local)

    def _text(self, token: Token) -> ParsedTerm:
        try:
            text = text_of(token)
        except TermError as error:
            self._cursor.report(token, SyntaxMessage(f"this text {error}"))
            return None, extent(token)
        after = self._cursor.peek
        if after.kind == "at" and after.text not in ("@prefix", "@base"):
            return self._tagged(text, self._cursor.take()), Extent(token.start, after.end)
        if after.kind == "datatype":
            self._cursor.take()
            return self._typed(text, after), Extent(token.start, self._cursor.before.end)
        return ox.Literal(text), extent(token)

    def _tagged(self, text: str, tag: Token) -> ox.Literal | None:
        try:
            return ox.Literal(text, language=tag.text[1:])
        except ValueError:
            self._cursor.report(
                tag, SyntaxMessage(f"`{tag.text}` is not a language tag", "write a tag such as `@en` or `@en-GB`")
            )
            return None

    def _typed(self, text: str, mark: Token) -> ox.Literal | None:
        if self._cursor.peek.kind not in ("iri", "name"):
            self._cursor.report(
                mark, SyntaxMessage("a datatype is missing after `^^`", "write one, such as `xsd:double`")
            )
            return None
        datatype = self._named(self._cursor.take())
        return ox.Literal(text, datatype=datatype) if datatype is not None else None

    def _named(self, token: Token) -> ox.NamedNode | None:
        iri = self.iri(token)
        if iri is None:
            return None
        try:
            return make_node(iri)
        except TermError as error:
            self._cursor.report(token, SyntaxMessage(f"{quote_token(token)} {error}"))
            return None

    def _name(self, token: Token) -> str | None:
        prefix, local = local_of(token)
        after = self._cursor.peek
        if after.kind == "stray" and after.start == token.end and after.text.startswith("/"):
            whole = token.text + self._cursor.take().text
            message = SyntaxMessage(f"`{whole}` is not a name", f"write an IRI in angle brackets: `<{whole}>`")
            self._cursor.report(token, message)
            return None
        base = self.prefixes.base_of(prefix, token)
        return None if base is None else base + local

    def _iri(self, token: Token) -> str | None:
        try:
            return iri_of(token, self._base)
        except TermError as error:
            self._cursor.report(token, SyntaxMessage(f"{quote_token(token)} {error}"))
            return None
