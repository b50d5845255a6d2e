"""Relaxes a domain for abstract objects, each of which represents several individuals.

Each predicate p is split in two. Positive conditions read `may-p`, which is never deleted for an abstract object;
negative conditions read `p`, which is never true for an abstract object. For all other objects the two are equal.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import assert_never

from msgspec import structs

from skillc_model.pddl.domain import ROOT, Action, ClassMeaning, PlanningDomain, Predicate, RelationMeaning
from skillc_model.pddl.formulas import (
    TRUE,
    Atom,
    Change,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
    conjunction,
    disjunction,
)
from skillc_model.pddl.names import make_unique
from skillc_model.read_write import unique_sides
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.problem.relevance import list_literals


class NotRelaxable(Exception):
    """A conditional effect whose condition reads another atom than the one that it deletes."""


class DomainRelaxation:
    """Relaxes the actions of a domain and formulas; `mark` is the predicate of abstract objects."""

    def __init__(self, domain: PlanningDomain, goal: Formula, vocabulary: Vocabulary) -> None:
        self._domain, self._vocabulary = domain, vocabulary
        taken = {*domain.names, *domain.predicate}
        self.mark = make_unique("is-abstract", taken)
        read = [goal, *(conjunction((each.precondition, each.hold)) for each in domain.actions)]
        signs = {(atom.predicate, sign) for formula in read for sign, atom in list_literals(formula)}
        self.negated = frozenset(name for name, sign in signs if not sign)
        self.may = {name: make_unique(f"may-{name}", taken) for name, sign in sorted(signs) if sign}

    def relax_domain(self) -> PlanningDomain:
        """Return the relaxed domain; NotRelaxable if an effect cannot be relaxed."""
        known = self._domain.predicate
        predicates = [known[name] for name in sorted(self.negated)]
        predicates += [structs.replace(known[name], name=may) for name, may in sorted(self.may.items())]
        marked = Predicate(self.mark, (Typed("?subject", ROOT),), ClassMeaning(""), False)
        actions = tuple(self._relax_action(each) for each in self._domain.actions)
        return replace(self._domain, predicates=(*predicates, marked), actions=actions)

    def relax(self, formula: Formula) -> Formula:
        """Return the relaxation of a condition whose objects may be abstract."""
        match formula:
            case Atom(predicate, terms):
                return Atom(self.may[predicate], terms)
            case Equal() | Negation(Atom()):
                return formula
            case Negation(Equal(left, _)):
                return disjunction((formula, Atom(self.mark, (left,))))
            case Conjunction(parts):
                return conjunction(self.relax(part) for part in parts)
            case Disjunction(parts):
                return disjunction(self.relax(part) for part in parts)
            case Existential(variable, body):
                return Existential(variable, self.relax(body))
            case Universal(variable, body):
                return Universal(variable, self.relax(body))
            case Negation():
                raise AssertionError(f"{formula} is not in negation normal form")
            case _:
                assert_never(formula)

    def _relax_action(self, action: Action) -> Action:
        changes = dict.fromkeys(each for change in action.effects for each in self._relax_change(change))
        return structs.replace(
            action,
            precondition=self.relax(action.precondition),
            hold=self.relax(action.hold),
            effects=tuple(sorted(changes, key=lambda change: not change.positive)),
        )

    def _relax_change(self, change: Change) -> Iterator[Change]:
        atom = change.atom
        if change.positive:
            if change.condition != TRUE:
                raise NotRelaxable
            if atom.predicate in self.may:
                yield Change(Atom(self.may[atom.predicate], atom.terms), True)
            if atom.predicate in self.negated:
                yield Change(atom, True, (), self._is_concrete(atom))
            yield from self._delete_former(atom)
        elif change.apart is not None:
            yield from self._delete(atom, change.variables, change.apart)
        else:
            raise NotRelaxable

    def _delete_former(self, atom: Atom) -> Iterator[Change]:
        """Yield the deletions of the former values of a functional or inverse functional relation."""
        predicate = self._domain.predicate[atom.predicate]
        if not isinstance(predicate.meaning, RelationMeaning):
            return
        for unique in unique_sides(predicate.meaning.relation, self._vocabulary):
            former = Typed("?former-other", predicate.parameters[1 - unique.fixed].type)
            terms = (atom.terms[0], former.name) if unique.fixed == 0 else (former.name, atom.terms[1])
            yield from self._delete(Atom(atom.predicate, terms), (former,))

    def _delete(self, atom: Atom, variables: tuple[Typed, ...], apart: Formula = TRUE) -> Iterator[Change]:
        """Yield the deletions of an atom if `apart` holds; deleting `p` itself unconditionally only relaxes further."""
        if atom.predicate in self.negated:
            yield Change(atom, False, variables)
        if atom.predicate in self.may:
            condition = conjunction((self._is_concrete(atom), apart))
            yield Change(Atom(self.may[atom.predicate], atom.terms), False, variables, condition)

    def _is_concrete(self, atom: Atom) -> Formula:
        """Return the formula that none of the atom's terms is an abstract object."""
        return conjunction(Negation(Atom(self.mark, (each,))) for each in atom.terms)
