"""What can be wrong with the data sheets of a scene's devices.

## wrong-sheet: a device has a data sheet of another kind of device

Bad:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:wsg50-sheet ;
        skiros:BaseFrameId "map" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0.6 ;
        skiros:OrientationW 1 ; skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ;
        skiros:CompliantController "impedance" .

Good:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:iiwa14-sheet ;
        skiros:BaseFrameId "map" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0.6 ;
        skiros:OrientationW 1 ; skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ;
        skiros:CompliantController "impedance" .

## joint-numbers: an arm's data sheet does not speak of each joint once

Greatest speeds and accelerations, and the joint values of each posture, are one number for each joint, separated by
spaces; greatest ones are above 0.

Bad:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:own-sheet a skillc:ArmSheet ; skillc:model "robots/ur5e.xml" ; skillc:reach 0.85 ; skillc:shoulderHeight 0.16 ;
        skillc:jointSpeeds "3.14 3.14 3.14 3.14 3.14" ; skillc:hasPosture skillc:ur5e-home ;
        skillc:armature 0.1 ; skillc:linearStiffness 1500 ; skillc:rotationalStiffness 200 ; skillc:dampingRatio 1 ;
        skillc:commandTime 0.1 ; skillc:forceLimit 50 ; skillc:speedLimit 0.5 ; skillc:accelerationLimit 0.5 .

Good:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:own-sheet a skillc:ArmSheet ; skillc:model "robots/ur5e.xml" ; skillc:reach 0.85 ; skillc:shoulderHeight 0.16 ;
        skillc:jointSpeeds "3.14 3.14 3.14 3.14 3.14 3.14" ; skillc:hasPosture skillc:ur5e-home ;
        skillc:armature 0.1 ; skillc:linearStiffness 1500 ; skillc:rotationalStiffness 200 ; skillc:dampingRatio 1 ;
        skillc:commandTime 0.1 ; skillc:forceLimit 50 ; skillc:speedLimit 0.5 ; skillc:accelerationLimit 0.5 .
"""
