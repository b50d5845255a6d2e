"""What can be wrong with where and how large the things of a scene are.

## missing-property: an individual does not say what its class must

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Bench a skillc:Furniture ; skiros:at lab:Here .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Bench a skillc:Furniture ; skiros:at lab:Here ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 1 .

## no-place: the scene does not say where something is

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Bench a skillc:Furniture ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 1 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Bench a skillc:Furniture ; skiros:at lab:Here ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 1 .

## partial-pose: a pose is only half there

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

## no-rotation: the four numbers of an orientation are no rotation

They are a unit quaternion: their squares add up to one.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 0 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

## unknown-frame: a pose is given in a frame that there is not

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "mpa" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

## frame-circle: frames are given in one another, in a circle

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "here" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

## not-a-range: the lower end of a range is above its upper end

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Slab a skillc:Surface ; skiros:at lab:Here ; skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ;
        skillc:frictionLow 0.4 ; skillc:frictionHigh 0.3 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Slab a skillc:Surface ; skiros:at lab:Here ; skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ;
        skillc:frictionLow 0.3 ; skillc:frictionHigh 0.4 .

## missing-friction: a surface does not say how much it rubs

Either `skillc:friction`, or both ends of what it may be.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Slab a skillc:Surface ; skiros:at lab:Here ; skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Here a skillc:Workstation ; skiros:FrameId "here" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
    lab:Slab a skillc:Surface ; skiros:at lab:Here ; skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ;
        skillc:friction 0.4 .
"""
