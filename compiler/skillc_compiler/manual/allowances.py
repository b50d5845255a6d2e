"""Comments that allow warnings.

## unused-allow: a comment allows a warning that there is not

`# allow NAME: reason` takes away the warnings called NAME on the line below. A comment that takes none away is left
over from a text that was different, or stands above the wrong line. Errors cannot be allowed.

Bad:

    use rparts
    skill Rest {
        # allow unused-parameter: the driver needs to know the arm
        in arm: ArmDevice
        noplan
    }
    impl resting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use rparts
    # allow no-implementation: every laboratory has its own
    skill Rest {
        in arm: ArmDevice
        noplan
    }

## unknown-allow: a comment allows something that is no warning

Bad:

    use rparts
    # allow no-implementaton: every laboratory has its own
    skill Rest {
        in arm: ArmDevice
        noplan
    }
    impl resting of Rest { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use rparts
    # allow no-implementation: every laboratory has its own
    skill Rest {
        in arm: ArmDevice
        noplan
    }

## allow-without-reason: a comment allows a warning without saying why

Whoever reads the file later wants to know whether the reason still holds.

Bad:

    use rparts
    # allow no-implementation
    skill Rest {
        in arm: ArmDevice
        noplan
    }

Good:

    use rparts
    # allow no-implementation: every laboratory has its own
    skill Rest {
        in arm: ArmDevice
        noplan
    }
"""
