"""Texts in the skill language that the tests of the front end share."""

VOCABULARY = """\
use skiros, rparts, wiping                                   # vocabularies, by prefix, from the ontology catalogue
prefix lab: <http://example.org/lab#>                        # any other prefix
import "motion.skill"                                        # declarations of another file of the library

class    Whiteboard < Surface
class    Eraser < Tool  disjoint Gripper
relation contain(Location, Product)
relation contain(GripperEffector, Product)                   # a second signature: an overload
relation at(Thing, Location)      functional
relation holds(Thing, Thing)      inverse heldBy symmetric transitive sub touches
property normalForce(Surface): Force
property isClean(Surface): Bool
function lanes(surface: Surface, width: Length, overlap: Number) -> [Pose] = python "skillc_runtime.motion.lanes:lanes"
"""

PICK = """\
## Take `object` out of its location. The gripper, the location and the poses are looked up in the world model.
skill Pick {
    in       arm:      ArmDevice
    in       object:   Product
    infer    gripper:  GripperEffector
    infer    from:     Location
    infer    approach: ApproachPose
    infer    grasp:    GraspingPose
    opt      speed:    Speed = 0.25 m/s  range 0.01 m/s .. 0.5 m/s

    pre      mounted:  arm hasA gripper
    pre      there:    from contain object
    pre      object hasA approach
    pre      object hasA grasp
    pre      empty:    not gripper contain _
    hold     ready:    arm.deviceState != Fault
    post     held:     gripper contain object
    post     gone:     not from contain object
    duration 8 s
}
"""

WIPE = """\
## One implementation for every arm with a compliant controller: impedance on a torque-controlled arm,
## forward-dynamics compliance on a position-controlled one. The controller itself is knowledge about the arm.
impl wipe_lanes of Wipe {
    refine   arm:    CompliantArm
    let      normal = surface.normal
    let      above  = offset(corner(surface, 0), 5 cm * normal)

    do seq {
        MoveLinear(arm, target: above, speed)
        # undone in reverse order on success, failure and halt
        with Compliance(arm, along: normal, stiffness: 0 N/m) {
            with Push(arm, along: normal, force: surface.normalForce) {
                par lead {
                    FollowPath(arm, path: lanes(surface, tool.width, 0.2), speed, blend: 1 cm)
                    OverlayCircle(arm, plane: normal, radius, rate)
                }
            }
        }
        MoveLinear(arm, target: above, speed)
        Inspect(surface)
    }
}

impl wsg of ActuateGripper {
    refine   gripper: WsgGripper
    refine   force:   Force  range 5 N .. 80 N
    run      python "skillc_runtime.primitives.gripper:ParallelGripper"
}
"""

TASKS = """\
task clean_whiteboard {                                      # by goal: planned
    scene "scenes/ur5e_whiteboard.ttl"
    goal  lab:Whiteboard-1.isClean == true
}
task wipe_table {                                            # by hand
    scene "scenes/iiwa_table.ttl"
    do    Wipe(arm: lab:Iiwa-1, surface: lab:Table-1)
}
"""

EVERYTHING = """\
skill Everything {
    ## Which arm.
    ## On two lines.
    in       arm:     ArmDevice
    infer any place:  lab:Place
    opt      limits:  [Force]
    out      result:  Pose
    uses     arm
    shares   arm
    scoped
    noplan
    fallback
    pause    between steps keep 500 ms
    pre      given limits
    pre      exists x: Class (x contain arm and x.size > 2 cm)
    pre      forall x: lab:Class-1 (x is Product implies not (x has weight or x == arm))
    pre      arm.load <= (2 + 3 * size) / 4 - -5 N
    post sensed clean: arm.isClean == true
    duration length(path) / speed + 1.5e1 s
}

impl everything of lab:Everything {
    prefer   2
    prefer   -1.5
    verify   never Push outside Compliance
    verify   Push before Inspect
    verify   after Push eventually Inspect
    verify   never force > 25 N
    do reactive seq {
        sel { reactive sel { Grip() } }
        par all { par any { } par race { } }
        retry 3 { repeat 2 { timeout 5 s { try { invert { once { Move(arm,) } } } } } }
        wait 20 ms
        wait until arm.ready == true
        wait until (arm.ready)
        wait until not arm touches _ and _ touches arm
        Move[fast](arm) -> result
        if a == b { } else if arm.ready == true { Grip() } else { Move() }
        while not arm.ready == true max 3 { Move() }
        for pose in poses { Move(target: pose) }
        check(arm is Arm)
        apply held, gone
    }
}
"""

ALL = {"vocabulary": VOCABULARY, "pick": PICK, "wipe": WIPE, "tasks": TASKS, "everything": EVERYTHING}
WHOLE = "\n".join(ALL.values())
