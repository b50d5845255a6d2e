"""What `skillc check` foresees of tasks in their scenes, before anything moves.

## unreachable-goal: no plan can reach a task's goal in its scene

The message follows the skills that could make the goal true back to what the scene lacks. Where no planner can take
the goal, it says what of the goal that is. A goal that the scene fulfils needs no plan and is never told.

Bad:

    use wiping
    prefix lab: <http://example.org/lab#>
    import "wiping/wipe.skill"

    task clean {
        scene "iiwa_table.ttl"
        goal  lab:Table-1.isClean == true
    }

Good:

    use wiping
    prefix lab: <http://example.org/lab#>
    import "wiping/wipe.skill"
    import "handling.skill"

    task clean {
        scene "iiwa_table.ttl"
        goal  lab:Table-1.isClean == true
    }

## no-answer: the scene has nobody that an inferred parameter could stand for

It is an error where no skill can change that, and a warning where it only holds at the task's beginning.

Bad:

    prefix lab: <http://example.org/lab#>
    import "wiping/wipe.skill"

    task clean {
        scene "iiwa_table.ttl"
        do    Wipe(surface: lab:Table-1)
    }

Good:

    prefix lab: <http://example.org/lab#>
    import "wiping/wipe.skill"
    import "handling.skill"

    task clean {
        scene "iiwa_table.ttl"
        do    seq {
            Pick(arm: lab:Iiwa-1, object: lab:Eraser-1)
            Wipe(surface: lab:Table-1)
        }
    }

## several-answers: the scene has several individuals that an inferred parameter could stand for

Pass the one that is meant, add a precondition that only it meets, or let any do with `infer any`.

Bad:

    use skiros, skillc
    prefix lab: <http://example.org/lab#>

    skill Look {
        infer table: Furniture
        in    place: Workstation
        pre   place contain table
        noplan
    }
    impl look of Look { do wait 1 s }

    task look {
        scene "iiwa_table.ttl"
        do    Look(place: lab:Cell)
    }

Good:

    use skiros, skillc
    prefix lab: <http://example.org/lab#>

    skill Look {
        infer table: Furniture
        in    place: Workstation
        pre   place contain table
        noplan
    }
    impl look of Look { do wait 1 s }

    task look {
        scene "iiwa_table.ttl"
        do    Look(place: lab:Cell, table: lab:Pedestal)
    }

## cannot-start: a task begins with a call that cannot start in its scene

Bad:

    use skiros, skillc
    prefix lab: <http://example.org/lab#>

    skill Rest {
        in  robot: MobileRobot
        pre robot at lab:Store
        noplan
    }
    impl rest of Rest { do wait 1 s }

    task rest {
        scene "ur5e_whiteboard.ttl"
        do    Rest(robot: lab:Heron-1)
    }

Good:

    use skiros, skillc
    prefix lab: <http://example.org/lab#>

    skill Rest {
        in  robot: MobileRobot
        pre robot at lab:Dock
        noplan
    }
    impl rest of Rest { do wait 1 s }

    task rest {
        scene "ur5e_whiteboard.ttl"
        do    Rest(robot: lab:Heron-1)
    }

## no-implementation-fits: no implementation of a skill takes an individual of a scene

It is an error where a task calls the skill so, and a warning where somebody might.

Bad:

    use rparts, skillc
    prefix lab: <http://example.org/lab#>

    skill Wave {
        in  arm:     ArmDevice
        in  gripper: GripperEffector
        pre arm hasGripper gripper
        noplan
    }
    impl with_jaws of Wave { refine gripper: ParallelGripper  do wait 1 s }
    impl by_ur of Wave { refine arm: Ur5e  refine gripper: ThreeFingerGripper  do wait 1 s }

    task wave {
        scene "iiwa_table.ttl"
        do    Wave(arm: lab:Iiwa-1, gripper: lab:Robotiq-1)
    }

Good:

    use rparts, skillc
    prefix lab: <http://example.org/lab#>

    skill Wave {
        in  arm:     ArmDevice
        in  gripper: GripperEffector
        pre arm hasGripper gripper
        noplan
    }
    impl with_jaws of Wave { refine gripper: ParallelGripper  do wait 1 s }
    impl by_others of Wave { do wait 1 s }

    task wave {
        scene "iiwa_table.ttl"
        do    Wave(arm: lab:Iiwa-1, gripper: lab:Robotiq-1)
    }

## unfit-sheet: an arm's data sheet does not serve its controller or its model

The sheet lacks what the controller needs, or its model is not there or has another number of joints than its postures.

Bad:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:ur5e-sheet ;
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

## unknown-controller: an arm of a scene names a controller that there is not

A controller is a file in the folder `controllers` of the runtime; the message lists them.

Bad:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:iiwa14-sheet ;
        skiros:BaseFrameId "map" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0.6 ;
        skiros:OrientationW 1 ; skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ;
        skiros:CompliantController "impedence" .

Good:

    @prefix lab:    <http://example.org/lab#> .
    @prefix skillc: <https://w3id.org/skillc/core#> .
    @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

    lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:iiwa14-sheet ;
        skiros:BaseFrameId "map" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0.6 ;
        skiros:OrientationW 1 ; skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 ;
        skiros:CompliantController "impedance" .

## unknown-scene: a task has a scene that there is not

A scene is a file, named relative to the file with the task, or one of the scenes that ship with skillc.

Bad:

    use wiping
    prefix lab: <http://example.org/lab#>
    import "wiping/wipe.skill"
    import "handling.skill"

    task clean {
        scene "iiwa_tabel.ttl"
        goal  lab:Table-1.isClean == true
    }

Good:

    use wiping
    prefix lab: <http://example.org/lab#>
    import "wiping/wipe.skill"
    import "handling.skill"

    task clean {
        scene "iiwa_table.ttl"
        goal  lab:Table-1.isClean == true
    }
"""
