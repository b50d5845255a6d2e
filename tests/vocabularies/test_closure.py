"""What follows from relations, and what a library changes by what its skills state."""

from skillc_dsl.position import Position
from skillc_model.conditions import Assert, Holds, Retract, Variable
from skillc_model.read_write import changing_terms, is_fixed, terms_written_by
from skillc_model.skills import Implementation, Post, Primitive, SkillLibrary
from skillc_rdf.vocabulary.types import RelationTerm, Vocabulary

HERE = Position("here", 1, 1)
X, Y = Variable("x"), Variable("y")


def relation(iri: str, *parents: str, **axioms: bool | str) -> RelationTerm:
    return RelationTerm(iri=iri, signatures=(), parents=parents, **axioms)


TERMS = [
    relation("at", functional=True),
    relation("beside", symmetric=True),
    relation("in", "at"),
    relation("on", "at"),
    relation("has", inverse="in"),
    relation("part", "within"),
    relation("within", transitive=True),
]
VOCABULARY = Vocabulary(relations={term.iri: term for term in TERMS})


def library(effect: Assert | Retract) -> SkillLibrary:
    condition = Holds(X, effect.relation, Y)
    post = Post(label="post", condition=condition, effects=(effect,), sensed=False, text="", source=HERE)
    body = Primitive("skillc.primitives:StandIn")
    implementation = Implementation(name="one", skill="Put", post=(post,), body=body, source=HERE)
    return SkillLibrary(
        name="own", namespace="", hash="", vocabulary=VOCABULARY, implementations={"Put.one": implementation}
    )


def test_inverses_stand_for_each_other_and_symmetric_relations_hold_both_ways() -> None:
    closure = VOCABULARY.closure
    assert closure.canonical("in") == ("has", True) and closure.canonical("has") == ("has", False)
    assert set(closure.implied["has"]) == {("has", False), ("in", True), ("at", True)}
    assert closure.implied["beside"] == (("beside", False), ("beside", True))
    assert set(closure.canonical_sources["at"]) == {("at", False), ("has", True), ("on", False)}
    assert closure.transitive == closure.chained == {"within"}


def test_stating_a_relation_changes_what_it_implies_and_what_a_functional_one_loses() -> None:
    assert changing_terms(library(Assert(X, "on", Y))) == {"on", "at", "in", "has"}
    assert changing_terms(library(Assert(X, "within", Y))) == {"within"}
    assert changing_terms(library(Retract(X, "within", Y))) == {"within", "part"}
    assert terms_written_by(Assert(X, "has", Y), VOCABULARY) == {"at", "has", "on"}


def test_only_what_no_skill_changes_is_fixed() -> None:
    changing = changing_terms(library(Assert(X, "on", Y)))
    assert is_fixed(Holds(X, "part", Y), changing, VOCABULARY)
    assert not is_fixed(Holds(X, "has", Y), changing, VOCABULARY)
