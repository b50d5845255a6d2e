"""Names of parameters, calls and individuals that mean nothing.

## unknown-function: there is no such function

Bad:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm:  ArmDevice
        in goal: Pose
        in up:   Vector of Length
        noplan
    }
    impl waiting of Rest {
        let above = ofset(goal, up)
        do  MoveTo(arm, target: above)
    }

Good:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm:  ArmDevice
        in goal: Pose
        in up:   Vector of Length
        noplan
    }
    impl waiting of Rest {
        let above = offset(goal, up)
        do  MoveTo(arm, target: above)
    }

## unknown-skill: there is no such skill

Bad:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePostur(arm) }

Good:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm) }

## unknown-implementation: a skill has no such implementation

`Skill[name](..)` fixes which implementation is taken.

Bad:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture[joint](arm) }

Good:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture[joints](arm) }

## unknown-parameter: a skill, implementation or body has no such name

Values come from the parameters, from `let`, from loops and from outputs of calls before; there is no global
blackboard. Individuals are written with their prefix.

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  griper contain object
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  gripper contain object
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-argument: a called skill has no such parameter

Bad:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm, pose: "home") }

Good:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm, posture: "home") }

## unknown-individual: the scene of a task has no such individual

Told where the scene is known: by `skillc check --scene` and whatever runs the task.

Bad:

    import "motion.skill"
    prefix lab: <http://example.org/lab#>
    task rest {
        scene "iiwa_table.ttl"
        do    TakePosture(arm: lab:Iiwa-2)
    }

Good:

    import "motion.skill"
    prefix lab: <http://example.org/lab#>
    task rest {
        scene "iiwa_table.ttl"
        do    TakePosture(arm: lab:Iiwa-1)
    }

## missing-prefix: a goal or call given at the command line names an individual without its prefix

Individuals are written with a prefix that the scene file declares.

Bad:

    Whiteboard-1.isClean == true

Good:

    lab:Whiteboard-1.isClean == true
"""
