"""Families of diagnostics, by their names: what a reader of the manual looks under."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase

REST = "more"
FAMILIES: tuple[tuple[str, str], ...] = (
    (
        "text",
        "syntax un*-brace unterminated-* unknown-character encoding empty-file duplicate-member repeated-member"
        " file-* nesting-* empty-block missing-space-* not-formatted *-allow allow-*",
    ),
    (
        "quantities",
        "*dimension* *-unit empty-range out-of-range *-angle bad-count bad-time bad-number *-operands numeric-*",
    ),
    (
        "scenes",
        "*-scene *turtle json-ld missing-prefix missing-property missing-friction no-fitting-* no-implementation-fits"
        " *-answer* cannot-start open-* unnamed-* frame-* unknown-frame unknown-controller no-place no-rotation"
        " partial-pose not-a-range wrong-data-type asymmetric-* irreflexive-* functional-* disjoint-classes area-*"
        " turned-area wrong-sheet unfit-sheet joint-numbers no-effect same-individuals denied-fact"
        " different-from-itself containment-circle",
    ),
    ("properties", "verify-*"),
    (
        "implementations",
        "*-python* not-a-primitive not-a-device not-narrower recursion missing-body no-implementation *-select*",
    ),
    (
        "data flow",
        "*argument* out-* unset-* no-output *-inference sensed-* not-scoped not-an-individual",
    ),
    ("planning", "unplannable-* *-goal colliding-* unreachable-skill"),
    (
        "ontology",
        "relation-* property-* wrong-type disjoint-* two-values breaks-* unknown-datatype unknown-dimension"
        " unknown-value computed-* contradicting-declaration class-* impossible-* *-vocabulary shipped-term"
        " undeclared-term redeclared-term prefix-taken missing-import unused-axiom several-inverses several-domains"
        " beyond-owl-dl",
    ),
    ("names", "unknown-* ambiguous-* duplicate-[adlnp]* unused-* import-* deprecated-*"),
    (
        "logic",
        "never-ends not-endless always-* contradict* duplicate-condition no-effect post-* hold-* *-effect"
        " *-precondition not-a-condition *-released *parallel* unreachable-* not-decided",
    ),
)
"""Patterns of names; the first family with one that fits counts."""


def family(name: str) -> str:
    """Return the family of a diagnostic; `more` for those of none."""
    return next((title for title, patterns in FAMILIES if any(fnmatchcase(name, p) for p in patterns.split())), REST)


def by_family(names: Iterable[str]) -> Mapping[str, tuple[str, ...]]:
    """Return names in alphabetical order by their family, the families in order of the table."""
    ordered = sorted(names)
    titles = (*(title for title, _ in FAMILIES), REST)
    grouped = {title: tuple(name for name in ordered if family(name) == title) for title in titles}
    return {title: members for title, members in grouped.items() if members}
