"""An `apply` of a label that no post has, or of a post that only a measurement can establish."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Program, Requirement, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.spelling import did_you_mean

NAMES = ("unknown-label", "sensed-post-applied")
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each label that cannot be applied."""
    for implementation in program.implementations:
        if isinstance(implementation.body, TypedNode):
            requirements = (*implementation.skill.requirements, *implementation.requirements)
            yield from _labels(implementation.body, [r for r in requirements if r.kind == "post"])
    for task in program.tasks:
        if task.body:
            yield from _labels(task.body, [])


def _labels(body: TypedNode, posts: Sequence[Requirement]) -> Iterator[Diagnostic]:
    labelled = {post.label.text: post for post in posts if post.label}
    for node in nodes_in(body):
        if isinstance(node.written, s.ApplyPosts):
            for name in node.written.labels:
                yield from _label(name, labelled)


def _label(name: s.Name, labelled: dict[str, Requirement]) -> Iterator[Diagnostic]:
    if name.text not in labelled:
        yield Diagnostic(
            "unknown-label",
            name.span,
            f"no post has the label `{name.text}`",
            help=did_you_mean(name.text, labelled) or f"label the post: `post {name.text}: ..`",
        )
    elif labelled[name.text].sensed:
        yield Diagnostic(
            "sensed-post-applied",
            name.span,
            f"`{name.text}` is sensed: only a measurement can establish it",
            help="call a skill that measures it",
            labels=(Label(labelled[name.text].span, "marked `sensed` here"),),
        )
