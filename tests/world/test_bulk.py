"""Reading all at once is reading one by one: the same world, and nothing that is wrong goes through."""

from __future__ import annotations

import os
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from scene.mutations import mutants
from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_in_bulk, read_documents
from skillc_runtime.world.state.bulk import FactTables, build_world_state
from skillc_runtime.world.state.changes import AddIndividual, AddRelation
from skillc_runtime.world.state.consistency.representatives import satisfies_axioms
from skillc_runtime.world.state.world_state import WorldState
from world.lab import NS, VOCABULARY, fact, individual, iri
from world.sameness import everything
from world.test_state import CLASSES, NAMES, additions, vocabularies

SEEDS = int(os.environ.get("SCENE_SEEDS", "5"))
SHEETS = tuple(Document(name, text) for name, text in catalogue.vocabulary_files())
SCENES = catalogue.scene_names()

PREFIXES = {
    "lab": "http://example.org/lab#",
    "owl": "http://www.w3.org/2002/07/owl#",
    "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
    "skiros": "http://rvmi.aau.dk/ontologies/skiros.owl#",
}


@settings(max_examples=int(os.environ.get("BULK_EXAMPLES", "25")))
@given(vocabularies(), st.lists(additions, max_size=12), st.randoms(use_true_random=False))
def test_a_state_made_at_once_is_that_made_by_changes(
    vocabulary: Vocabulary, added: list[AddRelation], chance: Random
) -> None:
    types = {iri(name): [iri(each) for each in chance.sample(CLASSES, chance.randint(1, 2))] for name in NAMES}
    one_by_one = WorldState.empty(vocabulary).with_changes(
        [*(AddIndividual(name, tuple(of)) for name, of in types.items()), *added]
    )
    related = {relation: [(a.subject, a.object) for a in added if a.relation == relation] for relation in NAMES_OF}
    assume({(r, *pair) for r, pairs in related.items() for pair in pairs} == _asserted(one_by_one))
    assert everything(build_world_state(vocabulary, FactTables(types, related, {}))) == everything(one_by_one)


NAMES_OF = tuple(map(iri, ("p", "q", "r", "s")))


def _asserted(state: WorldState) -> set[tuple[str, str, str]]:
    return {(iri, *pair) for iri, links in state.asserted.items() for pair in links.pairs()}


@pytest.fixture(scope="module")
def shipped() -> Vocabulary:
    return libraries.load_vocabulary()


@pytest.mark.parametrize("name", SCENES)
def test_shipped_scenes_are_read_quickly_and_alike(name: str, shipped: Vocabulary) -> None:
    documents = [Document.read(catalogue.scene_path(name)), *SHEETS]
    found = load_in_bulk(documents, shipped)
    assert found is not None and everything(found) == everything(read_documents(documents, shipped).state)


def test_data_sheets_alone_are_read_quickly_and_alike(shipped: Vocabulary) -> None:
    found = load_in_bulk(SHEETS, shipped, scenes=0)
    assert found is not None and everything(found) == everything(read_documents(SHEETS, shipped).state)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_what_is_wrong_with_a_changed_scene_is_never_passed_over(name: str, shipped: Vocabulary) -> None:
    text = catalogue.scene_path(name).read_text("utf-8")
    wrong = right = 0
    for mutant in mutants(text, range(SEEDS)):
        documents = [Document("scene.ttl", mutant.text), *SHEETS]
        careful, found = read_documents(documents, shipped), load_in_bulk(documents, shipped)
        if careful.problems:
            wrong += 1
            assert found is None, (mutant.kind, mutant.line, mutant.before, mutant.after, careful.problems)
        elif found is not None:
            right += 1
            assert everything(found) == everything(careful.state), (mutant.line, mutant.before, mutant.after)
    assert wrong and right + wrong > SEEDS // 2


WORDS = {
    "a": ("Location", "Robot", "Arm", "CompliantArm", "WsgGripper", "Product", "Eraser", "Board", "Spaceship", "Mug"),
    "relation": ("at", "contain", "containedIn", "hasA", "hasGripper", "within-it", "near", "beside", "holds"),
    "property": ("isClean", "weight", "label", "state", "load", "colour"),
    "value": ("3", "3.0", "0.5", "true", '"Idle"', '"red"@en', '"3 kg"', '"INF"^^xsd:double', "'blue'"),
}


def random_scene(chance: Random) -> str:
    """Return a scene of a few statements, of which some may be wrong."""
    usual = chance.random() < 0.7
    lines = [f"@prefix t: <{NS}> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> . @prefix : <x:y#> ."]
    things = {name: chance.choice(WORDS["a"][: 8 if usual else None]) for name in "abcdefgh"}
    lines += (f":{name} a t:{cls} ." for name, cls in things.items() if usual or chance.random() < 0.9)
    for _ in range(chance.randint(1, 4)):
        one, other = chance.choice("abcdefgh"), chance.choice("abcdefgh")
        if chance.random() < 0.5:
            lines.append(f":{one} t:{chance.choice(WORDS['relation'][: 8 if usual else None])} :{other} .")
        else:
            lines.append(f":{one} t:{chance.choice(WORDS['property'][:3])} {chance.choice(WORDS['value'])} .")
    chance.shuffle(rest := lines[1:])
    own = (
        "t:Mug a <http://www.w3.org/2002/07/owl#Class> ; <http://www.w3.org/2000/01/rdf-schema#subClassOf> t:Product ."
    )
    return "\n".join([lines[0], *rest, *([own] if chance.random() < 0.3 else [])])


@pytest.mark.parametrize(
    ("more", "problems"),
    [
        ("lab:A a owl:NamedIndividual .", []),
        ("lab:Alone a owl:NamedIndividual .", ["unknown-individual"]),
        ("lab:Alone a owl:NamedIndividual ; rdfs:label 'alone' .", ["unknown-individual"]),
        ("skiros:contain a owl:Class .", ["no-effect"]),
        ("skiros:Product a owl:Class .", []),
        ("lab:Cup a owl:Class . lab:B a lab:Cup .", []),
        ("lab:A skiros:Weight 1e400 .", ["wrong-data-type"]),
    ],
)
def test_the_quick_reader_passes_over_nothing(more: str, problems: list[str], shipped: Vocabulary) -> None:
    prefixes = "".join(f"@prefix {name}: <{iri}> .\n" for name, iri in PREFIXES.items())
    documents = [Document("s.ttl", f"{prefixes}lab:A a skiros:Product .\n{more}")]
    found = read_documents(documents, shipped).problems
    assert [each.name for each in found] == problems
    assert not problems or load_in_bulk(documents, shipped) is None


def test_random_scenes_are_read_alike() -> None:
    wrong = right = 0
    for seed in range(SEEDS * 20):
        documents = [Document("scene.ttl", random_scene(Random(seed)))]
        careful, found = read_documents(documents, VOCABULARY), load_in_bulk(documents, VOCABULARY)
        if careful.problems:
            wrong += 1
            assert found is None, (documents[0].text, careful.problems)
        elif found is not None:
            right += 1
            assert everything(found) == everything(careful.state), documents[0].text
    assert min(wrong, right) > SEEDS


SOUND = [individual("box", "Product"), individual("table", "Location"), fact("table", "contain", "box")]
UNSOUND = [
    [fact("table", "contain", "nobody")],
    [fact("table", "contain", "table")],
    [fact("box", "contain", "table")],
    [individual("table", "Robot")],
    [individual("ship", "Spaceship")],
    [individual("a", "Holder"), individual("b", "Holder"), fact("a", "contain", "b"), fact("b", "contain", "a")],
]


def test_a_sound_world_is_one_whose_every_fact_obeys() -> None:
    empty = WorldState.empty(VOCABULARY)
    assert satisfies_axioms(empty.with_changes(SOUND))
    assert UNSOUND and not any(satisfies_axioms(empty.with_changes([*SOUND, *changes])) for changes in UNSOUND)  # type: ignore[list-item]
