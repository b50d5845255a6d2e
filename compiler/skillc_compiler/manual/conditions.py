"""Conditions and data flow that cannot be understood.

## not-a-condition: a value stands where a condition is expected

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  object.PublishTf
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  object.PublishTf == true
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## not-an-individual: a value or term stands where an individual is expected

A relation, `has` and `is` speak of individuals: parameters, or individuals of the scene.

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  skiros:Location contain object
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  exists place: Location (place contain object)
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## no-output: `->` takes an output from a skill that has none

Bad:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm) -> posture }

Good:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm) }
"""
