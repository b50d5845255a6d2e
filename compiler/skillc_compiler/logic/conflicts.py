"""Whether two facts exclude each other, by their meaning, the axioms of relations, or the values of a property."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_compiler.logic.bounds import Bound, are_disjoint, constant_bound
from skillc_compiler.logic.conjunctions import TypedFact
from skillc_model.conditions import Anything, HasProperty, Holds, Individual, IsA, PropertyOf, Term
from skillc_rdf.vocabulary.types import Vocabulary


class Link(msgspec.Struct, frozen=True):
    """A relation from its subject to its object."""

    subject: Term
    relation: str
    object: Term


class Conflicts(msgspec.Struct, frozen=True):
    """The facts that exclude each other under the axioms of a vocabulary."""

    vocabulary: Vocabulary

    def implied(self, fact: Holds) -> Iterator[Link]:
        """Yield every link that a relation implies: its own, those of its super-relations, and inverses."""
        for term, subject, object_ in self.vocabulary.implied_links(fact.relation, fact.subject, fact.object):
            yield Link(subject, term.iri, object_)

    def exclude(self, one: TypedFact, other: TypedFact) -> bool:
        """Whether the two facts cannot both be true."""
        if one.meaning == other.meaning:
            return one.holds != other.holds
        if not one.holds:
            one, other = other, one
        return one.holds and (
            self._relations_exclude(one, other) or self._values_exclude(one, other) or self._classes_exclude(one, other)
        )

    def is_impossible(self, fact: Holds) -> bool:
        """Whether an axiom forbids the relation between its two terms."""
        return any(
            link.subject == link.object and not isinstance(link.object, Anything) and self._never_to_itself(link)
            for link in self.implied(fact)
        )

    def two_values(self, one: Holds, other: Holds) -> str | None:
        """Return a single-valued relation that is given two differently named values, or None."""
        for mine in self.implied(one):
            for theirs in (link for link in self.implied(other) if link.relation == mine.relation):
                term = self.vocabulary.relations[mine.relation]
                same_subject, same_object = mine.subject == theirs.subject, mine.object == theirs.object
                if (term.functional and same_subject and not same_object) or (
                    term.inverse_functional and same_object and not same_subject
                ):
                    return mine.relation
        return None

    def are_opposite(self, one: Holds, other: Holds) -> bool:
        """Whether an asymmetric relation holds from a to b in one fact and from b to a in the other."""
        back = {(link.relation, link.object, link.subject) for link in self.implied(other)}
        return any(
            self.vocabulary.relations[link.relation].asymmetric and (link.relation, link.subject, link.object) in back
            for link in self.implied(one)
        )

    def _never_to_itself(self, link: Link) -> bool:
        term = self.vocabulary.relations[link.relation]
        return term.irreflexive or term.asymmetric

    def _relations_exclude(self, one: TypedFact, other: TypedFact) -> bool:
        match one.meaning, other.meaning:
            case Holds() as mine, Holds() as theirs if other.holds:
                named = self.two_values(mine, theirs)
                return self.are_opposite(mine, theirs) or (
                    named is not None and self._are_distinct(named, mine, theirs)
                )
            case Holds() as mine, Holds() as absent:
                return any(covers(absent, link) for link in self.implied(mine))
        return False

    def _are_distinct(self, relation: str, one: Holds, other: Holds) -> bool:
        """Whether the sides in which two facts of a relation differ are certainly two individuals."""
        links = [next(link for link in self.implied(fact) if link.relation == relation) for fact in (one, other)]
        ends = [(getattr(links[0], end), getattr(links[1], end)) for end in ("subject", "object")]
        return any(isinstance(a, Individual) and isinstance(b, Individual) and a != b for a, b in ends)

    def _values_exclude(self, one: TypedFact, other: TypedFact) -> bool:
        mine, theirs = constant_bound(one.meaning), constant_bound(other.meaning)
        if mine is not None and theirs is not None and mine.of == theirs.of:
            return are_disjoint(mine, theirs if other.holds else theirs.opposite())
        match mine, other.meaning:
            case Bound(of=PropertyOf(of=of, property=name)), HasProperty(subject=subject, property=absent):
                return not other.holds and (of, name) == (subject, absent)
        return False

    def _classes_exclude(self, one: TypedFact, other: TypedFact) -> bool:
        match one.meaning, other.meaning:
            case IsA(subject=mine, cls=cls), IsA(subject=theirs, cls=other_cls) if mine == theirs:
                clash = self.vocabulary.disjoint if other.holds else self.vocabulary.is_a
                return clash(cls, other_cls)
        return False


def covers(absent: Holds, link: Link) -> bool:
    """Whether a negated relation covers a link."""
    subject = isinstance(absent.subject, Anything) or absent.subject == link.subject
    object_ = isinstance(absent.object, Anything) or absent.object == link.object
    return absent.relation == link.relation and subject and object_
