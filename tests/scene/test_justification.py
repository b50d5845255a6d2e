"""Of a fact that rules of ontologies derive it is said from which facts and by which axioms it follows."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from scene.test_classification import CASES, SOME, TERMS, read
from skillc.cli.main import skillc
from skillc.services.scene.rule_reasons import RuleReasons
from skillc_dsl.source import Source
from skillc_runtime.scene.classification import DERIVED, SceneRules
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.justification import justify
from vocabularies.reading import HEAD, T, beside

NOISE = f"t:E owl:equivalentClass [ a owl:Restriction ; owl:onProperty t:s ; owl:someValuesFrom t:A ] .\n{TERMS}"


@pytest.mark.parametrize("case", ["by an inverse", pytest.param("one rule after another", marks=pytest.mark.slow)])
def test_each_part_of_a_reason_is_needed(case: str) -> None:
    axioms, facts, _ = CASES[case]
    scene = read(f"{axioms}\n{NOISE}", f"{facts} t:z t:r t:x . t:z a t:C ; t:s t:u . t:u a t:C .")
    vocabulary = scene.state.vocabulary
    rules = SceneRules(vocabulary)
    derived = {(each.subject, each.predicate, each.object) for each in scene.said if each.lines.path == DERIVED}
    found = [each for iri, _, _ in derived for each in justify(scene.said, vocabulary, str(iri).strip("<>"))]
    assert {(each.fact[0], each.fact[1].value, each.fact[2]) for each in found} == derived
    for each in found:
        units = [number for number, unit in enumerate(rules.units) if unit[0] in each.rules]
        assert each.fact in rules.close(each.facts, units)
        for fact in each.facts:
            assert each.fact not in rules.close(set(each.facts) - {fact}, units)
        for unit in units:
            assert each.fact not in rules.close(each.facts, set(units) - {unit})


def test_an_axiom_has_its_line() -> None:
    head = f"{HEAD}{TERMS}"
    line = head.count("\n") + 1
    text = (
        f"t:D owl:equivalentClass [ owl:oneOf ( t:o ) ] .\nt:D owl:equivalentClass {SOME} .\n"
        "[ a owl:Class ; owl:intersectionOf ( t:C t:E ) ] rdfs:subClassOf t:D .\n"
        "[ a owl:Class ; owl:intersectionOf ( t:D t:C ) ] rdfs:subClassOf t:E .\n"
    )
    source = Source("t.ttl", f"{head}{text}")
    vocabulary = beside(source).value
    reasons = RuleReasons(
        Document.of("cell.ttl", f"{HEAD}t:x a t:C ; t:q t:y . t:y a t:B ."), vocabulary, (source,)
    ).describe(f"{T}x")
    shown = {each.fact: (each.since, [at.line - line for at in each.axioms]) for each in reasons}
    assert set(shown) == {("t:x", "a", "t:D"), ("t:x", "a", "t:E")}
    since = {("t:x", "t:r", "t:y"), ("t:y", "a", "t:A")}
    assert set(shown["t:x", "a", "t:D"][0]) == since and shown["t:x", "a", "t:D"][1] == [1]
    assert set(shown["t:x", "a", "t:E"][0]) == {*since, ("t:x", "a", "t:C")}
    assert sorted(shown["t:x", "a", "t:E"][1]) == [1, 3]


def test_the_world_shows_it(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "skillc.toml").write_text('name = "a"\nontology = ["terms"]\n', encoding="utf-8")
    (tmp_path / "a.skill").write_text("use skiros, t\n", encoding="utf-8")
    (tmp_path / "terms").mkdir()
    (tmp_path / "terms" / "t.ttl").write_text(f"{HEAD}{TERMS}t:D owl:equivalentClass {SOME} .\n", encoding="utf-8")
    (tmp_path / "cell.ttl").write_text(f"{HEAD}t:x a t:C ; t:r t:y . t:y a t:A .\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    shown = CliRunner().invoke(skillc, ["world", "cell.ttl", "--show", "t:x"])
    assert "  rules    a t:D, since " in shown.stdout and "t:y a t:A" in shown.stdout, shown.output
    assert "(terms/t.ttl:" in shown.stdout
    data = json.loads(CliRunner().invoke(skillc, ["world", "cell.ttl", "--show", "t:x", "--json"]).stdout)
    assert data[0]["rules"][0]["fact"] == ["t:x", "a", "t:D"] and len(data[0]["rules"][0]["since"]) == 2
