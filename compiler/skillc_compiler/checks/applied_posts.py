"""An `apply` of a label that no post has, or of a post that only a measurement can establish."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Requirement, Skill, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.spelling import did_you_mean

NAMES = ("unknown-label", "sensed-post-applied")
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each label that cannot be applied."""
    for implementation in program.implementations:
        if isinstance(implementation.body, TypedNode):
            requirements = (*implementation.skill.requirements, *implementation.requirements)
            yield from _check_labels(implementation.body, requirements, implementation.skill)
    for task in program.tasks:
        if task.body:
            yield from _check_labels(task.body, ())


def _check_labels(
    body: TypedNode, requirements: Sequence[Requirement], skill: Skill | None = None
) -> Iterator[Diagnostic]:
    labelled = {each.label.text: each for each in requirements if each.label}
    for node in nodes_in(body):
        if isinstance(node.written, s.ApplyPosts):
            for name in node.written.labels:
                yield from _check_label(name, labelled, requirements, skill)


def _by_position(name: str, requirements: Sequence[Requirement]) -> Requirement | None:
    """Return the post without a label that messages call by its number, as in `post2`."""
    posts = [each for each in requirements if each.kind == "post"]
    return next((each for n, each in enumerate(posts, 1) if name == f"post{n}" and each.label is None), None)


def _report_unlabelled(name: s.Name, post: Requirement) -> Diagnostic:
    start = post.condition.span._replace(end_line=post.condition.span.line, end_column=post.condition.span.column)
    label = f"{name.text}: "
    return Diagnostic(
        "unknown-label",
        name.span,
        f"the post that `{name.text}` means has no label, and `apply` needs one",
        help=f"write `post {label}{post.text}`",
        labels=(Label(post.span, "this post"),),
        fix=Fix(start, label, f"label the post `{name.text}`"),
    )


def _check_label(
    name: s.Name, labelled: Mapping[str, Requirement], requirements: Sequence[Requirement], skill: Skill | None
) -> Iterator[Diagnostic]:
    found = labelled.get(name.text)
    if found is None or found.kind != "post":
        unlabelled = _by_position(name.text, requirements)
        if unlabelled is not None:
            yield _report_unlabelled(name, unlabelled)
            return
        posts = [label for label, each in labelled.items() if each.kind == "post"]
        meant = did_you_mean(name.text, posts)
        labels: tuple[Label, ...] = ()
        if found is not None:
            labels = (Label(found.span, f"this is a `{found.kind}`", is_cause=True),)
        elif skill is not None and not meant:
            labels = (Label(skill.name_span, f"`{skill.name}` has no such post", is_cause=True),)
        yield Diagnostic(
            "unknown-label",
            name.span,
            f"no post has the label `{name.text}`",
            help=meant or f"label the post: `post {name.text}: ..`",
            labels=labels,
        )
    elif found.sensed:
        yield Diagnostic(
            "sensed-post-applied",
            name.span,
            f"`{name.text}` is sensed: only a measurement can establish it",
            help="call a skill that measures it",
            labels=(Label(found.span, "marked `sensed` here"),),
        )
