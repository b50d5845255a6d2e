"""A child that changes something that its skill does not declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from skillc_compiler.analysis.findings import UndeclaredEffect
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.analysis.remedy_lines import add_lines, remedy_lines
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.types import Vocabulary

NAMES = ("undeclared-effect",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each body with effects of calls that last beyond the skill and that no `post` declares."""
    groups: dict[str, list[UndeclaredEffect]] = defaultdict(list)
    for one in findings_of(proofs, UndeclaredEffect):
        groups[one.implementation.key].append(one)
    for key, (one, *others) in groups.items():
        skill = one.implementation.skill
        lines = _lines([one, *others], proofs[key].vocabulary)
        added = " and ".join(f"`{line}`" for line in lines)
        calls = " and ".join(dict.fromkeys(f"`{each.call.written.skill.text}`" for each in (one, *others)))
        effects = " and ".join(dict.fromkeys(f"`{each.post.text}`" for each in (one, *others)))
        passed = dict.fromkeys(name for each in (one, *others) if each.remedy for name in each.remedy.passed)
        then = f", and pass {' and '.join(f'`{name}`' for name in passed)} to {calls}" if passed else ""
        verb, what = "cause" if " and " in calls else "causes", added or "a `post` that declares it"
        yield Diagnostic(
            "undeclared-effect",
            one.call.written.skill.span,
            f"{calls} {verb} {effects}, which `{skill.name}` does not declare",
            help=f"add {what} to `{skill.name}` or to this implementation{then}, or undo it",
            labels=(
                Label(one.post.span, "the effect"),
                Label(skill.name_span, "whose posts do not declare it"),
                *(Label(other.call.written.skill.span, f"causes `{other.post.text}`") for other in others),
                *path_labels(one.path),
            ),
            fix=add_lines(lines, skill) if lines and not passed else None,
        )


def _lines(effects: Sequence[UndeclaredEffect], vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the lines that declare all effects, parameters first; none if one of them cannot be declared."""
    remedies = [each.remedy for each in effects if not each.missing]
    if None in remedies:
        return ()
    said = [line for each in remedies if each is not None for line in remedy_lines(each, vocabulary)]
    said += [f"post {each.missing}" for each in effects if each.missing]
    order = ("infer", "pre", "post")
    return tuple(sorted(dict.fromkeys(said), key=lambda line: order.index(line.partition(" ")[0])))
