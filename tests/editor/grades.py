"""A library with the forms of edition 2: enumerations, outcomes, ends of blocks, defined relations, tests."""

GRADES = """use skiros, skillc, rparts
prefix lab: <http://example.org/lab#>
import "motion.skill"
import "noting.skill"

enum     Grade { Good, Rework }
enum     Mood { Good, Bad }
class    Cup < Product
property grade(Product): Grade
property mood(Workstation): Mood
property isOpen(Cup): Bool
property load(Product): Mass range 0 kg .. 5 kg
relation standsIn(x: Product, l: Location) = l contain x or exists m: Location (l contain m and m contain x)

## Look at `part`.
skill Judge {
    in    part:    Product
    infer station: Workstation
    opt   want:    Grade = Good
    pre   here:    station contain part
    senses part.grade
    outcome good:    part.grade == Good likely 0.9
    outcome rework:  part.grade == Rework
    duration 2 s
}

impl by_camera of Judge {
    run python "skillc.primitives:StandIn"
}

## Let only a good `part` pass.
skill Approve {
    in   part: Product
    in   arm:  ArmDevice
    out  seen: Int
    post sensed part.grade == Good
    noplan
}

impl by_judging of Approve {
    out  seen = count(c: Cup where c.isOpen == true)
    do seq {
        Judge(part)
        for cup: Cup where cup.isOpen == true by count(c: Cup where c.isOpen == true) { wait 1 s }
        if not part.grade == Good { fail "the part is not good" }
    } on failure as why {
        if why.kind == "space" { Note(text: "{part} stays") }
        if why.kind == "body" { fail "{why.skill} of {part.grade}" }
        fail "no: {why}"
    } finally {
        TakePosture(arm)
    }
    verify never MoveTo outside Approve
}

test a_part_passes {
    scene  "iiwa_table.ttl"
    start  Judge -> good
    do     Approve(part: lab:Eraser-1, arm: lab:Iiwa-1)
    expect lab:Eraser-1.grade == Good
}
"""
