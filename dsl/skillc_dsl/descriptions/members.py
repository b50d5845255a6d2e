"""The members of skills, implementations, tasks and tests."""

from __future__ import annotations

from skillc_dsl.descriptions.rows import Construct, Flag, Word, reserved, words

PARAMETERS = (
    Construct("member", reserved("in"), "in NAME: TYPE", "the caller, always"),
    Construct(
        "member",
        (*reserved("opt"), *words("range")),
        "opt NAME: TYPE = VALUE range VALUE .. VALUE",
        "the caller, or the default; one without a default may be read only under `given NAME`",
    ),
    Construct(
        "member",
        (*reserved("infer"), *words("any")),
        "infer NAME: CLASS",
        "the world model, through the preconditions. A caller may also pass it; it is then checked. The skill does not "
        "start if no individual fits, or if several fit; `infer any` takes the first of several in the order of their "
        "IRIs. A precondition with a relation, a property value or a class can determine the individual. A negative "
        "condition alone is enough for `infer any` only",
    ),
    Construct(
        "member",
        reserved("out"),
        "out NAME: TYPE` or `out NAME = VALUE",
        "the implementation: an output of a skill that it calls, a value that is [computed at its "
        "end](#outputs-that-are-computed), or its Python class",
    ),
)
"""Parameters, with where their values come from."""

MEMBERS = (
    Construct(
        "member",
        reserved("pre"),
        meaning="a precondition: must hold when the skill starts; `pre of` takes over [those of a "
        "call](#preconditions-of-a-call)",
    ),
    Construct(
        "member",
        reserved("hold"),
        meaning="a hold condition: checked every tick while the skill runs. When it is violated, everything inside the "
        "skill is halted and the skill fails; the failure names the condition",
    ),
    Construct(
        "member",
        (
            *reserved("post"),
            Word("sensed", "leading"),
            *words("some", since=2),
            Word("possible", "leading", 2),
            *words("when", "trailing", since=2),
            *words("tolerance", "trailing", since=2),
        ),
        meaning="a postcondition: true afterwards; a conjunction of literals, of [effects on "
        "many](#effects-on-many) and of [changes of numbers](#changes-of-numbers), or an [effect on something that "
        "nobody named](#effects-on-things-nobody-named); `post possible` says what [may be "
        "so](#effects-that-are-possible). The postconditions of a primitive "
        "are written to the world model when it succeeds, "
        "as [assumed](world-model.md#evidence-for-a-fact) unless its code has written them as sensed. The "
        "postconditions of a compound must be established by the skills that it calls or by `apply`; the compiler "
        "proves this. A `post sensed` must have been "
        "[sensed](world-model.md#evidence-for-a-fact) since the skill started: it is checked and never written; that "
        "it was true before the skill started is not enough",
    ),
    Construct(
        "member",
        words("senses", "trailing", since=2),
        "senses THING.PROPERTY",
        meaning="the skill makes this property known; see [sensing with outcomes](#sensing-with-outcomes)",
        long=True,
    ),
    Construct(
        "member",
        (*words("outcome", "trailing", since=2), *words("likely", "trailing", since=2)),
        "outcome NAME: CONDITION likely NUMBER",
        meaning="what can come of the skill: exactly one of its outcomes holds after success, which was sensed",
        long=True,
    ),
    Construct(
        "member",
        words("duration", "trailing"),
        meaning="an expression for the expected time; the planner minimises it",
        long=True,
    ),
    Construct(
        "member",
        words("cost", "trailing", since=2),
        "cost NUMBER",
        meaning="an expression for what the skill costs, without a unit; [`minimise cost`](#tasks) adds it up",
        long=True,
    ),
    Construct(
        "member",
        reserved("uses"),
        meaning="locks a device, or any other individual such as a place or a workpiece, while the skill runs; a call "
        "[waits](#what-is-used-by-one-at-a-time) for what others use",
    ),
    Construct("member", reserved("shares"), meaning="adds to the motion of the skill that uses the device", long=True),
    Construct(
        "member",
        (Word("pause", "trailing"), *words("anywhere between steps"), Word("keep", "trailing")),
        meaning="where the skill may be [paused](#pauses), and after `keep` how long a paused tool goes on pressing",
        long=True,
    ),
)
"""What a skill states beside its parameters and flags."""

FLAGS = (
    Flag(
        "scoped",
        "the skill may be called in `with`: its effect is undone when the block ends",
        "Scoped: for use in `with`; what it sets up is undone at the end.",
        "scoped",
    ),
    Flag("noplan", "the planner does not use the skill", "Not used in planning.", "planned", False),
    Flag(
        "fallback",
        "if an implementation fails while it runs, the next one that fits is tried",
        "Another implementation takes over when one fails.",
        "fallback",
    ),
    Flag(
        "endless",
        "the skill never ends by itself, such as an overlay. Something around it must halt it, such as a `timeout` or "
        "the leading child of a `par lead`",
        "Never ends by itself.",
        "endless",
    ),
)
"""What a skill is declared to be. Each has its field in `skillc_model.skills.Skill`."""

OTHER_MEMBERS = (
    Construct(
        "member",
        reserved("refine"),
        "refine NAME: TYPE",
        "narrows a parameter of the skill: its class or range; it may have another default",
    ),
    Construct("member", reserved("let"), "let NAME = VALUE", "names a value, which is computed at the start"),
    Construct(
        "member",
        words("prefer", "trailing"),
        meaning="of implementations that are equally specific, the one with the higher number is selected",
    ),
    Construct(
        "member",
        (*reserved("run"), *words("python")),
        'run python "MODULE:CLASS"',
        "the primitive of Python that is run",
    ),
    Construct("member", reserved("do"), meaning="the body: a behaviour tree"),
    Construct("member", words("scene", "trailing"), 'scene "FILE.ttl"', "the world that it starts in, a Turtle file"),
    Construct(
        "member",
        words("backend", "trailing", since=2),
        "backend NAME",
        meaning="the [back end](backends.md) in whose cell the task runs, unless who runs it names another",
    ),
    Construct("member", words("goal", "trailing"), meaning="what has to hold at the end; it is planned"),
    Construct(
        "member",
        words("always", "trailing", since=2),
        meaning="what [neither the plan nor the run may break](#what-always-holds); a task or a test may have several",
    ),
    Construct(
        "member",
        words("within", "trailing", since=2),
        "within TIME",
        meaning="for how long the [task may go on](#tasks), from its start and without its pauses",
    ),
    Construct(
        "member",
        (*words("minimise", "trailing", since=2), *words("makespan work", since=2)),
        "minimise makespan`, `minimise work` or `minimise cost",
        "of what the [plan of the task](#tasks) has little, unless who plans or runs it says otherwise",
    ),
    Construct(
        "member",
        words("start", "trailing", since=2),
        meaning="what is so at the start of the test besides the scene, or what comes of a skill with outcomes",
    ),
    Construct(
        "member",
        (*words("expect plan", "trailing", since=2), *words("failure no", since=2)),
        'expect CONDITION`, `expect failure "TEXT"` or `expect no plan',
        "what holds at the end, or that the test fails, or that no plan reaches the goal",
    ),
    Construct(
        "member",
        reserved("verify"),
        meaning="a property of every execution, whatever succeeds or fails inside",
    ),
)
"""What implementations, tasks and tests state beside it."""
