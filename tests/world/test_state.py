"""The index against a naive model that works out the closure of everything from scratch."""

import os

from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_rdf.vocabulary.types import THING, ClassTerm, Vocabulary
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveIndividual, RemoveRelation
from skillc_runtime.world.state.world_state import WorldState
from world.lab import SCENE, fact, individual, iri, relation

NAMES = ("a", "b", "c", "d", "e")
RELATIONS = ("p", "q", "r", "s")
CLASSES = ("A", "B", "C")
Fact = tuple[str, str, str]


@st.composite
def vocabularies(draw: st.DrawFn) -> Vocabulary:
    """Draw four relations with random axioms and three classes with random superclasses."""
    terms = []
    for name in RELATIONS:
        flags = draw(st.sets(st.sampled_from(("symmetric", "transitive", "functional", "inverse_functional"))))
        if "transitive" in flags:
            flags -= {"functional", "inverse_functional"}
        parents = draw(st.sets(st.sampled_from(RELATIONS), max_size=2))
        inverse = draw(st.none() | st.sampled_from(RELATIONS))
        terms.append(relation(name, "Thing", "Thing", *sorted(parents), inverse=inverse, **dict.fromkeys(flags, True)))
    classes = [
        ClassTerm(iri=iri(name), parents=tuple(iri(each) for each in draw(st.sets(st.sampled_from(CLASSES)))))
        for name in CLASSES
    ]
    return Vocabulary(relations={term.iri: term for term in terms}, classes={term.iri: term for term in classes})


names, relations = st.sampled_from(NAMES), st.sampled_from(RELATIONS)
additions = st.builds(fact, names, relations, names)
changes = st.one_of(
    additions,
    additions,
    st.builds(lambda add: RemoveRelation(add.subject, add.relation, add.object), additions),
    st.builds(lambda name, types: individual(name, *types), names, st.sets(st.sampled_from(CLASSES)).map(sorted)),
    st.builds(lambda name: RemoveIndividual(iri(name)), names),
)


def closure(facts: set[Fact], vocabulary: Vocabulary, transitive: bool = True) -> set[Fact]:
    """Apply every axiom until nothing new follows."""
    terms = vocabulary.relations
    inverses = [(term.iri, term.inverse) for term in terms.values() if term.inverse]
    while True:
        new = {(s, parent, o) for s, r, o in facts for parent in terms[r].parents}
        new |= {(o, r, s) for s, r, o in facts if terms[r].symmetric}
        new |= {(o, other, s) for s, r, o in facts for one, other in inverses if one == r}
        new |= {(o, one, s) for s, r, o in facts for one, other in inverses if other == r}
        if transitive:
            new |= {(s, r, y) for s, r, o in facts if terms[r].transitive for x, q, y in facts if q == r and x == o}
        if new <= facts:
            return facts
        facts = facts | new


def implies(asserted: Fact, wanted: Fact, vocabulary: Vocabulary) -> bool:
    """Whether one assertion alone, without transitivity, makes a fact true."""
    return wanted in closure({asserted}, vocabulary, transitive=False)


def applied(facts: set[Fact], change: Change, vocabulary: Vocabulary) -> set[Fact]:
    """Make a change in the naive model."""
    match change:
        case AddRelation(s, r, o):
            for x, q, y in sorted(closure({(s, r, o)}, vocabulary, transitive=False)):
                edges = {each for fact in facts for each in closure({fact}, vocabulary, transitive=False)}
                term = vocabulary.relations[q]
                rivals = {e for e in edges if e[:2] == (x, q) and e[2] != y} if term.functional else set()
                rivals |= {e for e in edges if e[1:] == (q, y) and e[0] != x} if term.inverse_functional else set()
                facts = {f for f in facts if not any(implies(f, rival, vocabulary) for rival in rivals)}
            return facts | {(s, r, o)}
        case RemoveRelation(s, r, o):
            return {f for f in facts if not implies(f, (s, r, o), vocabulary)}
        case RemoveIndividual(gone):
            return {f for f in facts if gone not in (f[0], f[2])}
        case _:
            return facts


@settings(max_examples=int(os.environ.get("WORLD_EXAMPLES", "50")))
@given(vocabularies(), st.lists(st.lists(changes, max_size=6), min_size=1, max_size=6))
def test_every_version_holds_exactly_what_follows(vocabulary: Vocabulary, writes: list[list[Change]]) -> None:
    state, facts, types = WorldState.empty(vocabulary), set[Fact](), dict[str, set[str]]()
    versions = []
    for write in writes:
        state = state.with_changes(write)
        for change in write:
            facts = applied(facts, change, vocabulary)
            if isinstance(change, AddIndividual):
                types.setdefault(change.individual, set()).update(change.types)
            elif isinstance(change, RemoveIndividual):
                types.pop(change.individual, None)
        versions.append((state, closure(facts, vocabulary), {name: set(each) for name, each in types.items()}))
    for version, expected, classes in versions:
        assert_same(version, expected, classes)


def assert_same(state: WorldState, expected: set[Fact], types: dict[str, set[str]]) -> None:
    """Compare all that a state answers with the naive model."""
    vocabulary = state.vocabulary
    for name in map(iri, NAMES):
        for term in vocabulary.relations.values():
            assert state.objects(name, term.iri) == {o for s, r, o in expected if (s, r) == (name, term.iri)}
            assert state.subjects(term.iri, name) == {s for s, r, o in expected if (r, o) == (term.iri, name)}
    found = {(s, r, o) for r in vocabulary.relations for s, o in state.pairs(r)}
    assert found == expected
    for cls in (*vocabulary.classes, THING):
        members = {n for n, each in types.items() if cls == THING or any(vocabulary.is_a(one, cls) for one in each)}
        assert state.instances(cls) == {name for name in members if types[name]}


def test_a_functional_relation_loses_its_former_value_and_an_inverse_functional_one_its_holder() -> None:
    state = SCENE.with_changes([fact("robot", "at", "shelf"), fact("gripper", "contain", "eraser")])
    assert state.objects(iri("robot"), iri("at")) == {iri("shelf")}
    assert state.objects(iri("eraser"), iri("containedIn")) == {iri("gripper")}
    assert SCENE.objects(iri("eraser"), iri("containedIn")) == {iri("shelf")}
    assert state.holds(iri("robot"), iri("near"), iri("eraser"))
    assert not SCENE.holds(iri("robot"), iri("near"), iri("eraser"))


def test_versions_share_what_did_not_change() -> None:
    state = SCENE.with_changes([fact("robot", "at", "shelf")])
    untouched = [r for r in state.facts if r != iri("at")]
    assert untouched and all(state.facts[r] is SCENE.facts[r] for r in untouched)
    assert state.members is SCENE.members and state.stored is SCENE.stored
