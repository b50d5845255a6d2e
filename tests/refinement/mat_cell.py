"""A cell of a Panda that puts parts on a mat, before whose middle a pillar may stand."""

from __future__ import annotations

from pathlib import Path

SCENE = """
@prefix lab:    <http://example.org/lab#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Scene-1 a skiros:Scene ; skiros:contain lab:Cell .
lab:Cell a skillc:Workstation ; skillc:on lab:Scene-1 ;
    skiros:contain lab:Pedestal-1, lab:Table, lab:Part-A, lab:Part-B, lab:Mat{more} .
lab:Pedestal-1 a skillc:Furniture ; skiros:SizeX 0.3 ; skiros:SizeY 0.3 ; skiros:SizeZ 0.6 ; skillc:on lab:Cell .
lab:Table a skillc:Furniture ; skiros:SizeX 1.0 ; skiros:SizeY 1.4 ; skiros:SizeZ 0.6 ;
    skillc:on lab:Cell ; skillc:atX 0.75 .
lab:Robot-1 a skillc:FixedRobot ; skiros:at lab:Cell ; skillc:hasArm lab:Arm-1 .
lab:Arm-1 a skillc:Panda ; skillc:hasSheet skillc:panda-sheet ; skiros:CompliantController "impedance" ;
    skillc:on lab:Pedestal-1 ; skillc:deviceState "Idle" ; skillc:hasGripper lab:Hand-1 .
lab:Hand-1 a skillc:PandaHand ; skillc:hasSheet skillc:panda-hand-sheet ; skillc:deviceState "Idle" .
lab:Part-A a skiros:Product ; skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.06 ; skiros:Weight 0.15 ;
    skillc:on lab:Table ; skillc:atX -0.35 ; skillc:atY -0.3 .
lab:Part-B a skiros:Product ; skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.06 ; skiros:Weight 0.15 ;
    skillc:on lab:Table ; skillc:atX -0.25 ; skillc:atY -0.4 .
lab:Mat a skiros:Location ; skiros:SizeX 0.4 ; skiros:SizeY 0.5 ; skiros:SizeZ 0.004 ;
    skillc:on lab:Table ; skillc:atX -0.1 .
"""


PILLAR = """
lab:Pillar a skillc:Furniture ; skiros:SizeX 0.05 ; skiros:SizeY 0.05 ; skiros:SizeZ 0.4 ;
    skillc:on lab:Table ; skillc:atX -0.15 .
"""
"""What stands so near to the middle of the mat that the wrist does not get there."""


def write_mat(folder: Path, pillar: bool, facts: str = "") -> Path:
    """Write the scene, with further facts; return its file."""
    path = folder / "cell.ttl"
    path.write_text(SCENE.format(more=", lab:Pillar" if pillar else "") + (PILLAR if pillar else "") + facts)
    return path
