"""What planners cannot take.

## unplannable-construct: a planned skill says something that planners cannot take

Planners of PDDL bind individuals only and do not count. They cannot read what only a running skill knows: whether an
optional parameter was passed, a computed value that skills change. Planners with numbers, such as ENHSP, take
comparisons of numbers; Fast Downward and the built-in search do not. The skill is left out of planning.

Bad:

    use skiros
    skill Sort {
        in   place: Location
        in   other: Location
        pre  place.ContainerState == other.ContainerState
        post place.ContainerState == "Full"
    }
    impl waiting of Sort { run python "skillc_runtime.primitives.stand_in:StandIn" }

Good:

    use skiros
    skill Sort {
        in   place: Location
        pre  place.ContainerState == "Empty"
        post place.ContainerState == "Full"
    }
    impl waiting of Sort { run python "skillc_runtime.primitives.stand_in:StandIn" }
"""
