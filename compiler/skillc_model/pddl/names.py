"""PDDL names for the terms of a library and the objects of a scene, and the mapping back.

A name has lower-case letters, digits and `-`, starts with a letter, is not a PDDL keyword, and is unique even when
planners fold case. If two terms would get the same name, both are prefixed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence

from skillc_model.pddl.constants import find_mentions
from skillc_model.pddl.kebab import to_kebab
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import PlainType, PropertyTerm, Vocabulary, local_name

_WORDS_OF_PDDL = """
    action all always and assign at at-end at-most-once at-start axiom condition constants constraints decrease define
    derived domain duration durative-action effect either end exists forall functions goal hold-after hold-during imply
    increase init length maximize metric minimize not number object objects or over parameters precondition predicates
    preference problem requirements scale-down scale-up sometime sometime-after sometime-before start total-cost
    total-time types undefined when within
"""
_WORDS_OF_OURS = "goal-reached idle reach-goal thing"
KEYWORDS = frozenset((_WORDS_OF_PDDL + _WORDS_OF_OURS).split())


def assign_names(library: SkillLibrary) -> dict[str, str]:
    """Return PDDL name -> IRI of a class, relation or property, `property=value` of a value, or skill name.

    Individuals that skills name are included: they are constants of the domain.
    """
    vocabulary = library.vocabulary
    wanted = {iri: _of_iri(iri, vocabulary) for iri in (*vocabulary.classes, *vocabulary.relations)}
    for iri, term in vocabulary.properties.items():
        wanted |= {value_key(iri, value): _of_value(iri, value, vocabulary) for value in finite_values(term)}
    wanted |= {name: (to_kebab(name), f"skill-{to_kebab(name)}") for name in library.skills}
    named = {each.individual for found in find_mentions(library).values() for each in found}
    wanted |= {iri: _of_iri(iri, vocabulary) for iri in named - wanted.keys()}
    return _inverse(allocate_names(wanted))


def assign_object_names(iris: Iterable[str], vocabulary: Vocabulary, taken: Collection[str]) -> dict[str, str]:
    """Return object name -> IRI for the individuals of a scene; no name is in `taken`."""
    plain = {iri: to_kebab(local_name(iri)) for iri in iris}
    times = Counter((*plain.values(), *taken, *KEYWORDS))
    wanted = {iri: (name,) if times[name] == 1 else _of_iri(iri, vocabulary) for iri, name in plain.items()}
    return _inverse(allocate_names(wanted, taken))


def finite_values(term: PropertyTerm) -> tuple[bool | str, ...]:
    """Return the values of a property with finitely many values, each of which becomes a predicate; () otherwise."""
    return (True, False) if term.type == PlainType("Bool") else term.values


def value_key(iri: str, value: bool | str) -> str:
    """Return the key of a value's predicate in the table of names: the property for True, else `property=value`."""
    return iri if value is True else f"{iri}={'false' if value is False else value}"


def allocate_names(wanted: Mapping[str, Sequence[str]], taken: Collection[str] = ()) -> dict[str, str]:
    """Assign each key the first of its wanted names that no other key wants at the same position; number the rest."""
    used = KEYWORDS | set(taken)
    chosen: dict[str, str] = {}
    for stage in range(max((len(names) for names in wanted.values()), default=0)):
        open_ = {key: names[min(stage, len(names) - 1)] for key, names in sorted(wanted.items()) if key not in chosen}
        times = Counter(open_.values())
        granted = {key: name for key, name in open_.items() if times[name] == 1 and name not in used}
        chosen |= granted
        used |= set(granted.values())
    for key in sorted(wanted.keys() - chosen.keys()):
        chosen[key] = make_unique(wanted[key][-1], used)
        used |= {chosen[key]}
    return chosen


def make_unique(name: str, taken: Collection[str]) -> str:
    """Return the name, numbered from 2 if it is taken or a PDDL keyword."""
    candidate, number = name, 1
    while candidate in taken or candidate in KEYWORDS:
        number += 1
        candidate = f"{name}-{number}"
    return candidate


def make_variable(name: str, taken: Collection[str]) -> str:
    """Return a PDDL variable for a name of the library, different from all variables in `taken`."""
    plain = to_kebab(name)
    return make_unique(f"?the-{plain}" if plain in KEYWORDS else f"?{plain}", taken)


def _of_iri(iri: str, vocabulary: Vocabulary) -> tuple[str, ...]:
    return to_kebab(local_name(iri)), to_kebab(vocabulary.short(iri))


def _of_value(iri: str, value: bool | str, vocabulary: Vocabulary) -> tuple[str, ...]:
    ending = "" if value is True else f"-{to_kebab('false' if value is False else value)}"
    return tuple(name + ending for name in _of_iri(iri, vocabulary))


def _inverse(chosen: Mapping[str, str]) -> dict[str, str]:
    return {chosen[key]: key for key in sorted(chosen)}
