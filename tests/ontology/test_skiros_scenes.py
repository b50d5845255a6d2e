"""What SkiROS2 writes into scenes is understood: the terms of its robots, places and things, its types of numbers."""

from __future__ import annotations

from functools import cache

import pytest

from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_documents
from skillc_runtime.world.state.terms import SKILLC, SKIROS
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
PREFIXES = f"""@prefix lab: <{LAB}> . @prefix skillc: <{SKILLC}> . @prefix skiros: <{SKIROS}> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
"""
SCENE = """
lab:Cell-0 a skiros:Scene, owl:NamedIndividual ; rdfs:label "" ; skiros:DiscreteReasoner "Spatial"^^xsd:string ;
    skiros:FrameId "map"^^xsd:string ; skiros:PositionX "0.0"^^xsd:float ;
    skiros:contain lab:Robot-1, lab:Shelf-4, lab:Peg-5 .
lab:Robot-1 a cora:Robot, owl:NamedIndividual ; skiros:SkillMgr "mgr" ; skiros:PublishTf true ; skiros:hasA lab:Arm-2 ;
    skiros:DiscreteReasoner "Spatial", "Another" ; skiros:hasStartLocation lab:Shelf-4 ;
    skiros:Template "lab:robot" ; skiros:hasTemplate lab:robot ; skiros:hasSkill lab:Drive-6 .
lab:Drive a owl:class ; rdfs:subClassOf skiros:Skill .
lab:Drive-6 a lab:Drive ; skiros:hasParam lab:Parameter-7 .
lab:Parameter-7 a skiros:Parameter ; skiros:DataType "sumo:Agent" ; skiros:ParameterType 2 ; rdfs:comment "" .
lab:Arm-2 a rparts:ArmDevice ; skiros:at lab:Shelf-4 ; skillc:hasSheet skillc:iiwa14-sheet ; skiros:MotionExe "exe" ;
    skiros:CompliantController "compliant" ;
    skiros:JointConfigurationController "joints" ; skiros:CartesianGoalAction "/goal" ;
    skiros:CartesianStiffnessTopic "/k" ; skiros:CartesianWrenchTopic "/w" ; skiros:OverlayMotionService "/overlay" ;
    skiros:MoveItGroup "arm" ; skiros:MoveItReferenceFrame "base" ; skiros:MoveItTCPLink "tcp" ;
    skiros:DriverAddress "/driver" ; skiros:StateProperty "Idle" ; skiros:hasA lab:Gripper-3 .
lab:Gripper-3 a rparts:GripperEffector ; skiros:ContainerState "Empty" .
lab:Shelf-4 a skiros:Workstation ; skiros:PushToFrameId "map" ; skiros:LinkedToFrameId "marker" ;
    skiros:BaseFrameId "map" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ; skiros:OrientationW 1 ;
    skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 .
lab:Peg a owl:class ; rdfs:subClassOf skiros:Part .
lab:Peg-5 a lab:Peg ; skiros:CadModel "peg.stl" ; skiros:ForceX "1.5"^^xsd:float ; skiros:ForceY 0 ; skiros:ForceZ 0.0 ;
    skiros:VelocityX "0.25"^^xsd:double ; skiros:VelocityY 0.0 ; skiros:VelocityZ 0.0 ; skiros:Weight 3 .
"""


@cache
def vocabulary() -> Vocabulary:
    return load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value


def world(scene: str) -> WorldState:
    sheets = [Document(path, text) for path, text in catalogue.vocabulary_files()]
    return load_documents([*sheets, Document("scene.turtle", PREFIXES + scene)], vocabulary())


def value(state: WorldState, individual: str, property_: str) -> Value | None:
    return state.value(LAB + individual, SKIROS + property_)


def test_a_scene_with_every_term_of_skiros_is_read() -> None:
    state = world(SCENE)
    assert value(state, "Robot-1", "DiscreteReasoner") == ("Spatial", "Another")
    assert value(state, "Robot-1", "PublishTf") is True
    assert value(state, "Arm-2", "MoveItTCPLink") == "tcp"
    assert [value(state, "Peg-5", name) for name in ("ForceX", "ForceY", "VelocityX", "Weight")] == [
        1.5,
        0.0,
        0.25,
        3.0,
    ]
    assert state.objects(LAB + "Robot-1", SKIROS + "hasSkill") == {LAB + "Drive-6"}
    assert LAB + "robot" not in state.individuals


@pytest.mark.parametrize(
    ("before", "after", "problem"),
    [
        ('"Idle"', '"Tired"', "one of Idle, Busy"),
        ("skiros:MoveItGroup", "skiros:MoveItGruop", "skiros:MoveItGroup"),
        ("skiros:PublishTf true", 'skiros:PublishTf "maybe"', "skiros:PublishTf"),
        ('skiros:SkillMgr "mgr"', 'skiros:MotionExe "exe"', "skiros:MotionExe"),
    ],
)
def test_what_is_wrong_in_such_a_scene_is_told(before: str, after: str, problem: str) -> None:
    assert before in SCENE
    with pytest.raises(SceneError, match=problem):
        world(SCENE.replace(before, after))
