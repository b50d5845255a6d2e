"""A domain for things of which some stand for several: what cannot be said of all of these is not demanded.

Each predicate p is split in two. `may-p` is what conditions read: it is never taken from a stand-in again. `p` itself
is what denials read: it is never true of a stand-in. Of all other things both say the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import assert_never

from skillc_model.pddl.domain import ROOT, Action, ClassFact, PlanningDomain, Predicate, RelationFact
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
from skillc_model.pddl.names import fresh
from skillc_model.read_write import unique_sides
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.problem.relevance import list_literals


class NotRelaxable(Exception):
    """An effect whose condition reads something else than the atom that it deletes."""


class DomainRelaxation:
    """Weakens the actions of a domain and a goal; `mark` is the predicate that is true of stand-ins."""

    def __init__(self, domain: PlanningDomain, goal: Formula, vocabulary: Vocabulary) -> None:
        self._domain, self._vocabulary = domain, vocabulary
        taken = {*domain.names, *domain.predicate}
        self.mark = fresh("is-stand-in", taken)
        read = [goal, *(conjunction((each.precondition, each.hold)) for each in domain.actions)]
        signs = {(atom.predicate, sign) for formula in read for sign, atom in list_literals(formula)}
        self.denied = frozenset(name for name, sign in signs if not sign)
        self.may = {name: fresh(f"may-{name}", taken) for name, sign in sorted(signs) if sign}

    def domain(self) -> PlanningDomain:
        """Return the weakened domain; Refused when an effect cannot be weakened."""
        known = self._domain.predicate
        predicates = [known[name] for name in sorted(self.denied)]
        predicates += [replace(known[name], name=may) for name, may in sorted(self.may.items())]
        marked = Predicate(self.mark, (Typed("?subject", ROOT),), ClassFact(""), False)
        actions = tuple(self._action(each) for each in self._domain.actions)
        return replace(self._domain, predicates=(*predicates, marked), actions=actions)

    def formula(self, formula: Formula) -> Formula:
        """Return what remains of a condition when things may be stand-ins."""
        match formula:
            case Atom(predicate, terms):
                return Atom(self.may[predicate], terms)
            case Equal() | Negation(Atom()):
                return formula
            case Negation(Equal(left, _)):
                return disjunction((formula, Atom(self.mark, (left,))))
            case Conjunction(parts):
                return conjunction(self.formula(part) for part in parts)
            case Disjunction(parts):
                return disjunction(self.formula(part) for part in parts)
            case Existential(variable, body):
                return Existential(variable, self.formula(body))
            case Universal(variable, body):
                return Universal(variable, self.formula(body))
            case Negation():
                raise AssertionError(f"{formula} is not in negation normal form")
            case _:
                assert_never(formula)

    def _action(self, action: Action) -> Action:
        changes = dict.fromkeys(each for change in action.effects for each in self._changes(change))
        return replace(
            action,
            precondition=self.formula(action.precondition),
            hold=self.formula(action.hold),
            effects=tuple(sorted(changes, key=lambda change: not change.positive)),
        )

    def _changes(self, change: Change) -> Iterator[Change]:
        atom = change.atom
        if change.positive:
            if change.condition != TRUE:
                raise NotRelaxable
            if atom.predicate in self.may:
                yield Change(Atom(self.may[atom.predicate], atom.terms), True)
            if atom.predicate in self.denied:
                yield Change(atom, True, (), self._of_none(atom))
            yield from self._former(atom)
        elif change.apart is not None:
            yield from self._deletions(atom, change.variables, change.apart)
        else:
            raise NotRelaxable

    def _former(self, atom: Atom) -> Iterator[Change]:
        """Yield the deletion of all that cannot hold beside a relation, because a thing stands in it with one other."""
        predicate = self._domain.predicate[atom.predicate]
        if not isinstance(predicate.meaning, RelationFact):
            return
        for unique in unique_sides(predicate.meaning.relation, self._vocabulary):
            former = Typed("?former-other", predicate.parameters[1 - unique.fixed].type)
            terms = (atom.terms[0], former.name) if unique.fixed == 0 else (former.name, atom.terms[1])
            yield from self._deletions(Atom(atom.predicate, terms), (former,))

    def _deletions(self, atom: Atom, variables: tuple[Typed, ...], apart: Formula = TRUE) -> Iterator[Change]:
        """Yield the deletion of an atom, if things differ; to say too little with `p` itself makes nothing harder."""
        if atom.predicate in self.denied:
            yield Change(atom, False, variables)
        if atom.predicate in self.may:
            condition = conjunction((self._of_none(atom), apart))
            yield Change(Atom(self.may[atom.predicate], atom.terms), False, variables, condition)

    def _of_none(self, atom: Atom) -> Formula:
        """Return that the atom speaks of no stand-in."""
        return conjunction(Negation(Atom(self.mark, (each,))) for each in atom.terms)
