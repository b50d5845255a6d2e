"""What can be wrong with holes and patches of surfaces.

## area-beside-surface: a hole or a patch of a surface lies wholly beside it

Its place is that of its middle; where its frame is the surface's, as seen from the middle of that.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Slab a skillc:Surface ; skiros:FrameId "slab" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 3 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ; skillc:friction 0.4 ; skillc:hasHole lab:Socket .
    lab:Socket a skillc:Area ; skiros:BaseFrameId "slab" ; skiros:SizeX 0.1 ; skiros:SizeY 0.1 ;
        skiros:PositionX 3 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Slab a skillc:Surface ; skiros:FrameId "slab" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 3 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ; skillc:friction 0.4 ; skillc:hasHole lab:Socket .
    lab:Socket a skillc:Area ; skiros:BaseFrameId "slab" ; skiros:SizeX 0.1 ; skiros:SizeY 0.1 ;
        skiros:PositionX 0.3 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .

## turned-area: a hole does not lie along its surface's axes, or an area is tilted out of its surface

Lanes go around holes at right angles. Patches may be turned in their surface: each has lanes along its own axes.

Bad:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Slab a skillc:Surface ; skiros:FrameId "slab" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ; skillc:friction 0.4 ; skillc:hasHole lab:Socket .
    lab:Socket a skillc:Area ; skiros:BaseFrameId "slab" ; skiros:SizeX 0.1 ; skiros:SizeY 0.1 ;
        skiros:PositionX 0.3 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0.38268 ; skiros:OrientationW 0.92388 .

Good:

    @prefix lab: <http://example.org/lab#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .

    lab:Slab a skillc:Surface ; skiros:FrameId "slab" ; skiros:BaseFrameId "map" ;
        skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 ;
        skiros:SizeX 1 ; skiros:SizeY 1 ; skiros:SizeZ 0.02 ; skillc:friction 0.4 ; skillc:hasHole lab:Socket .
    lab:Socket a skillc:Area ; skiros:BaseFrameId "slab" ; skiros:SizeX 0.1415 ; skiros:SizeY 0.1415 ;
        skiros:PositionX 0.3 ; skiros:PositionY 0 ; skiros:PositionZ 0 ;
        skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ; skiros:OrientationW 1 .
"""
