"""Names that mean nothing, or too much.

A bare name is looked up in the vocabularies of the `use` line, in the file and in what it imports. `prefix:name` always
works.

## unknown-class: there is no such class

Bad:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  object is Tol
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  object is Tool
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-type: there is no such type

A type is a class, a dimension, or `Bool`, `Int`, `Number`, `Text`, `Pose`, `Vector`, `Direction`;
`Vector of Length` is a vector of a dimension, `[T]` a list.

Bad:

    skill Rest {
        opt time: Tiem = 5 s
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    skill Rest {
        opt time: Time = 5 s
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-relation: there is no such relation

Also where the condition must not hold: a misspelt one would never fail.

Bad:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  not gripper contains _
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  not gripper contain _
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-property: there is no such property

Bad:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  gripper.deviceStat == Idle
        pre  object.Weight < 1 kg
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  gripper.deviceState == Idle
        pre  object.Weight < 1 kg
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-value: a property has no such value

Some texts have a few possible values, which the vocabulary lists. Others name something that a data sheet describes, as
`TakePosture(arm, posture: "home")` names a posture of the arm: the class in Python that runs such a skill says so in
`text_names`. Arguments, defaults and local values are compared with what there is. In a task with a scene it is an
error when what the call is about has no such name; elsewhere a warning when neither a scene of the library nor a
shipped data sheet has it, since another scene may.

Bad:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  gripper.deviceState != Falt
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, rparts, skillc
    skill Hold {
        in   gripper: GripperEffector
        in   object:  Product
        pre  gripper.deviceState != Fault
        noplan
    }
    impl waiting of Hold { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-prefix: a prefix is not declared

The prefixes of all vocabularies are there; others are declared: `prefix lab: <http://example.org/lab#>`.

Bad:

    skill Rest {
        in arm: rpart:ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    skill Rest {
        in arm: rparts:ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-vocabulary: there is no such vocabulary

Bad:

    use rpart
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unknown-import: there is no such file

Files are looked for beside the one that imports them, then in the standard library.

Bad:

    use rparts
    import "motoin.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm) }

Good:

    use rparts
    import "motion.skill"
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl folded of Rest { do TakePosture(arm) }

## ambiguous-name: a bare name is found in several vocabularies

Here the vocabulary `shop` has a class `Part` too. Write the prefix of the one that is meant.

Bad:

    use skiros, shop
    skill Look {
        in part: Part
        noplan
    }
    impl waiting of Look { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros, shop
    skill Look {
        in part: skiros:Part
        in item: Item
        in tray: Container
        noplan
    }
    impl waiting of Look { run python "skillc_runtime.primitives.stand_in:StandIn" }

## deprecated-term: a class, relation or property should not be used any more

Its vocabulary says so with `owl:deprecated`, and with `dcterms:isReplacedBy` what to use instead. Here `shop:Ware` was
replaced by `shop:Item`.

Bad:

    use shop
    skill Look {
        in item: Ware
        noplan
    }
    impl waiting of Look { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use shop
    skill Look {
        in item: Item
        noplan
    }
    impl waiting of Look { run python "skillc_runtime.primitives.stand_in:StandIn" }
"""
