"""Binds the parameters of actions to objects with which atoms agree with known facts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import Atom
from skillc_runtime.planning.search.fact_index import FactIndex


class Bindings:
    """Bindings by the facts that are known when they are asked for; `members` are the objects of each type."""

    def __init__(self, facts: FactIndex, members: Mapping[str, Sequence[str]]) -> None:
        self._facts, self._members = facts, members
        self._sets = {type_: frozenset(names) for type_, names in members.items()}

    def extend(self, action: Action, atoms: Sequence[Atom], values: dict[str, str]) -> Iterator[dict[str, str]]:
        """Yield bindings of all parameters that extend `values`.

        Parameters are bound by the atom that the fewest facts agree with first, those in no atom by their type.
        """
        open_ = [each for each in action.parameters if each.name not in values]
        linked = [atom for atom in atoms if any(each.name in atom.terms for each in open_)]
        if not linked:
            for names in product(*(self._members[each.type] for each in open_)):
                yield {**values, **dict(zip((each.name for each in open_), names, strict=True))}
            return
        atom, fitting = self._facts.find_fewest(linked, values)
        rest = [each for each in atoms if each is not atom]
        types = {each.name: each.type for each in action.parameters}
        for terms in tuple(fitting):
            matched = self.match(atom, terms, values, types)
            if matched is not None:
                yield from self.extend(action, rest, matched)

    def match(
        self, atom: Atom, terms: tuple[str, ...], values: Mapping[str, str], types: Mapping[str, str]
    ) -> dict[str, str] | None:
        """Return `values` extended so that an atom has these objects; None if it cannot.

        types: of the parameters of the action.
        """
        matched = dict(values)
        for term, name in zip(atom.terms, terms, strict=True):
            if term in types and term not in matched:
                if name not in self._sets[types[term]]:
                    return None
                matched[term] = name
            elif matched.get(term, term) != name:
                return None
        return matched
