"""What becomes of a case in each artifact, found by using the artifact and comparing it with execution."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rdflib import OWL, RDF, RDFS, Graph, Namespace, URIRef

from emit.bt_player import Player
from emit.tree_rules import Reader
from matrix.case import Case, scene
from matrix.leaves import LibraryLeaves
from matrix.stage import SCRIPTS
from peers.comparing import differences_of
from skillc_compiler.emit import bt, owl
from skillc_model.always import keep_always
from skillc_model.codec import dumps, loads
from skillc_model.conditions import And
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.skills import SkillLibrary
from skillc_model.tree import Node
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.planning.problem.chains import unroll_chains
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState
from tree.stage import PERIOD_S, Stage

TICKS = 200
LOST = "not expressible"
SKIROS = Namespace("http://rvmi.aau.dk/ontologies/skiros.owl#")
SKILLC = Namespace("https://w3id.org/skillc/core#")
FLAGS = {
    "functional": OWL.FunctionalProperty,
    "symmetric": OWL.SymmetricProperty,
    "transitive": OWL.TransitiveProperty,
}
History = tuple[str, list[tuple[float, str, str]], frozenset[object]]


def measured(case: Case) -> Mapping[str, str]:
    """Return what becomes of a case, by the word of the artifact; AssertionError where two of them disagree."""
    library, errors = case.library()
    if errors:
        return {"refused": ", ".join(errors)}
    assert loads(dumps(library), case.name) == library
    return {"json": "same", "owl": in_owl(library), "pddl": in_pddl(library), **executed(library, case.expected["bt"])}


def in_owl(library: SkillLibrary) -> str:
    """Check that everything of the library is said in OWL."""
    made = Graph().parse(data=owl.emit(library)["skills.ttl"], format="turtle")
    base = Namespace(library.namespace)
    for skill in library.skills.values():
        assert {str(made.value(each, RDFS.label)) for each in made.objects(base[skill.name], SKIROS.hasParam)} == {
            each.name for each in skill.parameters
        }
        place, keep_s = (made.value(base[skill.name], word) for word in (SKILLC.pause, SKILLC.keep))
        assert (str(place or "anywhere"), keep_s and keep_s.toPython()) == (skill.pause.where, skill.pause.keep_s)
        texts = {str(made.value(each, SKILLC.conditionText)) for each in made.subjects(SKILLC.conditionText)}
        assert {each.text for each in (*skill.pre, *skill.hold, *skill.post)} <= texts
        for way in library.implementations_of(skill.name):
            assert (base[f"{skill.name}.{way.name}"], OWL.equivalentClass, None) in made
    for iri, relation in library.vocabulary.relations.items():
        if iri.startswith(str(base)):
            assert {name for name, kind in FLAGS.items() if (URIRef(iri), RDF.type, kind) in made} == {
                name for name in FLAGS if getattr(relation, name)
            }
            assert {str(each) for each in made.objects(URIRef(iri), RDFS.subPropertyOf)} == set(relation.parents)
    return "same"


def in_pddl(library: SkillLibrary) -> str:
    """Compare applicability and effects of every planned step with the world model; say what is left out and why."""
    from emit.unified import disagreements, temporal  # unified-planning takes seconds to import

    library = keep_always(library, [each for task in library.tasks.values() for each in task.always]).library
    excluded = [each.reason for each in make_planning_domain(library).excluded]
    unrolled = unroll_chains(library, scene(library), And(()))
    posed = unrolled.pose()
    if not posed.problem.domain.actions:
        return f"left out: {excluded[0]}" if excluded else "not planned"
    wrong, tried = disagreements(posed, unrolled.state, depth=1)
    assert wrong == []
    if any(each.duration or each.hold or each.uses for each in library.skills.values()):
        assert {each.name for each in temporal(posed.problem).actions} == set(posed.problem.domain.action)
    if excluded:
        return f"left out: {excluded[0]}"
    return "same" if tried else "read; the scene has nothing to plan with"


def executed(library: SkillLibrary, expected: str) -> Mapping[str, str]:
    """Run the task `go` with the engine and as an exported tree: both must do the same at the same time if expected."""
    task = library.tasks.get("go")
    if task is None or task.body is None:
        return {"bt": "no tree", "run": "by the planner"}
    text = bt.emit(library)["trees/task_go.xml"]
    assert list(differences_of("go", text)) == []
    by_engine, why = _by_engine(task.body, library)
    by_tree = _by_tree(text, library)
    ended = f"{by_engine[0]}{f', {why}' if why else ''}"
    if by_engine != by_tree:
        assert expected == LOST, (by_engine, by_tree)
        return {"bt": LOST, "run": ended}
    declared = sorted({path[1] for path in Reader.of(text).names().values() if path[0] == "" and path[1] != "task"})
    own = f"same, with {', '.join(declared)}" if declared else "same"
    return {"bt": own, "run": ended}


def _by_engine(body: Node, library: SkillLibrary) -> tuple[History, str]:
    stage = Stage(WorldModel(scene(library)), SCRIPTS)
    run = TreeRun(body, library, stage)  # type: ignore[arg-type]
    for number in range(TICKS):
        stage.now = number * PERIOD_S
        if run.tick() is not Status.RUNNING:
            break
    return _history(run.status.value, stage), run.failure.kind if run.failure else ""


def _by_tree(text: str, library: SkillLibrary) -> History:
    stage = Stage(WorldModel(scene(library)), SCRIPTS)
    leaves = LibraryLeaves(library, stage)
    player = Player(text, leaves)
    for number in range(TICKS):
        stage.now = leaves.now = number * PERIOD_S
        outcome = player.tick()
        if outcome is not None:
            return _history("success" if outcome.ok else "failure", stage)
    return _history("running", stage)


def _history(status: str, stage: Stage) -> History:
    """Return how a run ended, what it told primitives and when, but for ticks, and what is true in the end."""
    told = sorted(each for each in stage.log if each[1] != "tick")
    return status, told, frozenset(_facts(stage.world.snapshot()))


def _facts(state: WorldState) -> Iterator[object]:
    yield from ((relation, *pair) for relation in state.facts for pair in state.pairs(relation))
    for property_, table in state.stored.items():
        yield from ((property_, *entry) for entry in table.items())
