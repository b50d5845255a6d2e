"""Text that is not the language.

## syntax: something is missing, or stands where it does not fit

The message names what would fit. What was not understood is left out, and everything else is checked.

Bad:

    use rparts
    skill Rest {
        in arm ArmDevice
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

## unclosed-brace: a `{` has no `}`

Told where the brace opens that, as the indentation shows, was left open.

Bad:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unopened-brace: a `}` has no `{`

Bad:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }
    }

Good:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## missing-space-after-colon: a label stands right before its value

A space tells `arm: ArmDevice`, a label, from `rparts:ArmDevice`, a name with its prefix.

Bad:

    use rparts
    skill Rest {
        in arm:ArmDevice
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

## unknown-character: a character means nothing in the language

Bad:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan;
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use rparts
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## unterminated-string: a text in quotes does not end on its line

Bad:

    function gap() -> Length = python "skillc_runtime.primitives.stand_in:StandIn

Good:

    function gap() -> Length = python "skillc_runtime.primitives.stand_in:StandIn"

## unknown-unit: there is no such unit

A number and its unit are one value, `5 N`, which may be in any unit of its dimension.

Bad:

    skill Rest {
        opt width: Length = 5 inch
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    skill Rest {
        opt width: Length = 127 mm
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## repeated-member: a task says something twice

Bad:

    import "motion.skill"
    prefix lab: <http://example.org/lab#>
    task rest {
        scene "ur5e_whiteboard.ttl"
        scene "iiwa_table.ttl"
        do    TakePosture(arm: lab:Iiwa-1)
    }

Good:

    import "motion.skill"
    prefix lab: <http://example.org/lab#>
    task rest {
        scene "iiwa_table.ttl"
        do    TakePosture(arm: lab:Iiwa-1)
    }

## encoding: the file is not UTF-8

The bad example is saved as Latin-1, where the letters beyond ASCII are other bytes.

Bad:

    # Größe
    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    # Groesse
    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## nesting-too-deep: steps, conditions or values stand in each other more than 64 levels deep

Each pair of parentheses, each `not`, each block, each `else if` and each operator of a sum or product is a level. The
member or declaration that is too deep is left out, and everything else is checked.

Bad:

    use skillc
    skill Rest {
        in  board: Surface
        pre
            not not not not not not not not not not not not not not not not not not not not not not
            not not not not not not not not not not not not not not not not not not not not not not
            not not not not not not not not not not not not not not not not not not not not not not
            board.located == true
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skillc
    skill Rest {
        in  board: Surface
        pre board.located == true
        noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## file-too-large: the file is longer than 500,000 characters

It is not read at all. The bad example stands for a file in which it is repeated a thousand times.

Bad:

    # This is line after line after line of text that no program for a robot needs in a file, and nobody reads it.
    # There is some more of it here, and below, and so on, and so on, until over half a million letters are there.
    # Nobody writes so much by hand: some program has made it, or it is a recording that has got the name of a library.
    # Those who do have so many skills put them into several files, each about one thing, and import what they need.
    # Then the editor stays fast, too, and so do those who have to find something in it: they see what belongs together.

Good:

    skill Rest { noplan }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

## not-formatted: the file is not in its one layout

Told by `skillc fmt --check`, not by `skillc check`. `skillc fmt` lays files out: one member a line, words in columns,
calls of more than 120 columns with one argument a line, comments where they were.

Bad:

    skill Rest {
      opt width: Length = 127mm
    noplan
    }
    impl waiting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    skill Rest {
        opt  width: Length = 127 mm
        noplan
    }

    impl waiting of Rest {
        run python "skillc_runtime.primitives.stand_in:StandIn"
    }
"""
