"""The library that the tests write at: small, complete and without problems."""

MOTION = """use rparts

## Move the tool to `target`.
skill Move {
    in   arm:    ArmDevice
    in   target: Pose
    opt  speed:  Speed = 0.1 m/s  range 0.01 m/s .. 0.5 m/s

    uses arm
    pause anywhere keep 250 ms
    noplan
}

impl line of Move {
    run python "skillc_runtime.primitives.move:MoveLinear"
}
"""

PRESS = """use skiros, skillc, wiping
import "motion.skill"
import "compliance.skill"

class Panel < WipeableSurface
relation fixedTo(Panel, Location)  functional
property wear(Panel): Number
function lifted(pose: Pose, by: Length) -> Pose = python "skillc_runtime.world.places:raised"

## Press on `panel` with the tool.
skill Press {
    in    panel: Panel
    in    arm:   CompliantArm
    opt   push:  Force = 10 N  range 1 N .. 40 N
    infer at:    Location

    pre   fixed: panel fixedTo at
    hold  ready: arm.deviceState != Fault
    post  done:  panel.isClean == true
    duration 5 s
}

impl slowly of Press {
    let above = lifted(panel.pose, 5 cm)

    do seq {
        Move(arm, target: above)
        with Compliance(arm, along: panel.normal) {
            Push(arm, along: panel.normal, force: push)
        }
        apply done
    }
}
"""


def with_line(text: str, after: str, line: str) -> str:
    """Return a text with a line put in after the one that holds `after`."""
    lines = text.split("\n")
    found = next(number for number, each in enumerate(lines) if after in each)
    return "\n".join((*lines[: found + 1], line, *lines[found + 1 :]))


def marked(text: str, words: str, at: int = 0) -> str:
    """Return a text with the cursor `|` put `at` characters into its first `words`."""
    start = text.index(words) + at
    return f"{text[:start]}|{text[start:]}"


def replaced(text: str, old: str, new: str) -> str:
    """Return a text with one piece of it replaced; ValueError where there is no such piece."""
    start = text.index(old)
    return text[:start] + new + text[start + len(old) :]
