"""The nodes of behaviour trees."""

from __future__ import annotations

from skillc_dsl.descriptions.rows import Decorator, Node, Picture, Slot, Ticks, Word, reserved, words

NODES = (
    Node(
        "seq",
        reserved("seq"),
        "seq { .. }",
        "runs its children in order until one fails; it has memory: finished children do not run again",
        Picture("flow", "→"),
    ),
    Node(
        "sel",
        reserved("sel"),
        "sel { .. }",
        "runs its children in order until one succeeds; it has memory: finished children do not run again",
        Picture("flow", "?"),
    ),
    Node(
        "reactive seq",
        reserved("reactive"),
        "reactive seq { .. }",
        "the same as `seq`, but when the result of an earlier child is no longer valid (its postconditions, what it "
        "checked), the child that runs is halted, and the earlier one runs again",
        Picture("flow", "↻"),
    ),
    Node(
        "reactive sel",
        (),
        "reactive sel { .. }",
        "the same as `sel`, but when an earlier child could start, the child that runs is halted, and the earlier one "
        "starts. Nothing is started to find that out: its leading conditions and its first call are "
        "[tried](trees.md#what-a-selector-tries). An earlier child that has failed takes over only after it could not "
        "start for a tick",
        Picture("flow", "↻"),
    ),
    Node(
        "par",
        (*reserved("par"), *words("all race lead")),
        "par all { .. }",
        "the children run in parallel. `par all`: all must succeed; `par any`: the first success decides; `par race`: "
        "the first child to finish decides; `par lead`: the first child in the list decides. The other children are "
        "then halted",
        Picture("flow", "⇉"),
    ),
    Node("wait", words("wait"), "wait 1 s", "waits for a time", Picture("time", "◷")),
    Node(
        "wait until", words("until", "leading"), "wait until C", "waits until a condition holds", Picture("time", "◷")
    ),
    Node(
        "if",
        reserved("if else"),
        "if C { .. } else { .. }",
        "runs one of two branches; without `else`, a false condition succeeds",
        Picture("guard", "?"),
    ),
    Node(
        "on failure",
        words("on as", since=2),
        "seq { .. } on failure as why { .. }",
        "after `seq`, `sel`, `par`, `with` and a body of one step: runs the second block when the first one has "
        "failed, also by a broken hold, but not when it is halted; what `with` sets up is undone before. It succeeds "
        "if the second block does. [`why`](#failures) is optional",
        Picture("flow", "?"),
    ),
    Node(
        "finally",
        words("finally", since=2),
        "seq { .. } finally { .. }",
        "after `seq`, `sel`, `par`, `with`, `on failure` and a body of one step: runs the second block once the first "
        "one has succeeded or failed, but not when it is halted. The result stays that of the first; what "
        "[fails](#failures) in the second one is reported",
        Picture("flow", "→"),
    ),
    Node(
        "while",
        (*reserved("while"), *words("max", "trailing")),
        "while C max 10 { .. }",
        "repeats while the condition holds; fails if the condition still holds after 10 rounds",
        Picture("guard", "↻"),
    ),
    Node(
        "for",
        (*reserved("for"), *words("where", since=2), *words("by", "trailing", since=2)),
        "for NAME in LIST { .. }` or `for NAME: CLASS where C by VALUE { .. }",
        "once for each element, or for each individual [of a class](#loops-over-individuals)",
        Picture("flow", "↻"),
    ),
    Node(
        "check", words("check"), "check(C)", "success if the condition holds now, else failure", Picture("guard", "✓")
    ),
    Node(
        "fail",
        words("fail"),
        'fail "REASON"',
        "fails for this [reason](#texts-with-values)",
        Picture("guard", "✗"),
    ),
    Node("apply", reserved("apply"), "apply LABEL, ..", "writes these postconditions now", Picture("guard", "✎")),
    Node(
        "call",
        (),
        "Skill(name: value, name) -> out",
        "calls a skill and names its output. `Skill[impl](..)` fixes the implementation",
        Picture("call", "▶"),
    ),
    Node(
        "with",
        reserved("with"),
        "with SKILL(..) { .. }",
        "sets up a scoped skill, runs the block, then undoes the skill, however the block ends",
        Picture("call", "▶"),
    ),
)
"""The nodes that are not decorators."""

DECORATORS = (
    Decorator(
        Word("try", "nowhere"),
        "try { .. }",
        "turns failure into success, but never the violation of a hold or a halt",
        Ticks("the child", "the child", "", "succeeds if the child would fail"),
        Picture("flow", "~"),
        "ForceSuccess",
        "Turns a failure of its child into success, but not that of a broken hold condition.",
        on_failure="success",
    ),
    Decorator(
        Word("invert"),
        "invert { .. }",
        "exchanges success and failure",
        Ticks("the child", "the child", "", "the opposite of the child"),
        Picture("flow", "!"),
        "Inverter",
        "Exchanges success and failure of its child, but not the failure of a broken hold condition.",
        on_success="failure",
        on_failure="success",
    ),
    Decorator(
        Word("once"),
        "once { .. }",
        "runs its child at most once in a run of the skill",
        Ticks("the child, unless it has ended before", "the child", "", "as the child"),
        Picture("flow", "1"),
    ),
    Decorator(
        Word("retry"),
        "retry 3 { .. }",
        "runs the child until it succeeds, at most 3 times, but [not again](planning.md#what-a-run-learns) where it "
        "lacked space and nothing stands elsewhere since",
        Ticks(
            "the child",
            "the child that runs; after a failure, the next round starts in the next tick",
            "",
            "as its first round",
        ),
        Picture("flow", "↻"),
        "RetryUntilSuccessful",
        slots=(Slot("count", "count", "num_attempts"),),
        on_failure="again",
    ),
    Decorator(
        Word("repeat"),
        "repeat 3 { .. }",
        "runs the child exactly 3 times, as long as it succeeds",
        Ticks(
            "the child",
            "the child that runs; after a success, the next round starts in the next tick",
            "",
            "as its first round",
        ),
        Picture("flow", "↻"),
        "Repeat",
        slots=(Slot("count", "count", "num_cycles"),),
        on_success="again",
    ),
    Decorator(
        Word("timeout"),
        "timeout 3 s { .. }",
        "fails when the child takes longer; a child that ends just then is in time",
        Ticks(
            "the child",
            "the child, unless more than the time has passed",
            "the child, in the first tick after its time",
            "as the child",
        ),
        Picture("time", "◷"),
        "Timeout",
        slots=(Slot("time", "seconds", "msec"),),
    ),
)
"""The decorators. Each has a struct in `skillc_model.tree`, a rule of proof and a tick."""

PICTURES = {each.kind: each.picture for each in NODES}
DECORATOR_OF = {each.kind: each for each in DECORATORS}
