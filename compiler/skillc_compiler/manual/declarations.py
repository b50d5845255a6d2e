"""What is declared twice, or in two ways.

## duplicate-declaration: something is declared twice

Relations and properties may have several signatures; skills, implementations, tasks, classes and functions one
declaration.

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }
    impl resting of Hold {
        prefer 1
        run python "skillc_runtime.primitives.stand_in:StandIn"
    }

## duplicate-parameter: a parameter is declared or refined twice

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        in   object:  Location
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## duplicate-label: two conditions have the same label

Bad:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  ready: gripper.deviceState == Idle
        pre  ready: object has Weight
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  ready:  gripper.deviceState == Idle
        pre  weighed: object has Weight
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## duplicate-member: something that can be said once is said twice

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        duration 3 s
        duration 4 s
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        duration 3 s
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## duplicate-name: a name is taken already

What a `let`, a loop, a quantifier or an output names must not hide a parameter.

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre forall object: Product (object.Weight < 1 kg)
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre forall each: Product (each.Weight < 1 kg)
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## duplicate-prefix: a prefix is that of a vocabulary

Bad:

    prefix rparts: <http://example.org/lab#>
    import "motion.skill"
    task pause {
        scene "iiwa_table.ttl"
        do    TakePosture(arm: rparts:Iiwa-1)
    }

Good:

    prefix lab: <http://example.org/lab#>
    import "motion.skill"
    task pause {
        scene "iiwa_table.ttl"
        do    TakePosture(arm: lab:Iiwa-1)
    }

## contradicting-declaration: a property is declared again with another type

Bad:

    use skiros
    property filled(Product): Bool
    property filled(Location): Number

Good:

    use skiros
    property filled(Product): Bool
    property filled(Location): Bool

## redeclared-term: a declaration adds to a term of a vocabulary

A class, relation or property whose bare name is visible already is no new term: what is declared is added to the one
that there is, for every skill that speaks of it. Whoever means that writes the name with its prefix.

Bad:

    use skiros
    class Container < Product

Good:

    use skiros
    class Crate < Product
    class skiros:Container < Product

## import-cycle: files import one another in a circle

Also a file that imports itself. Move what both need into a third file.

Bad:

    import "example.skill"
    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }
"""
