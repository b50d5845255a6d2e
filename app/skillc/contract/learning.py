"""Learning of parameters from trials: what is asked for, and what comes of a job that learns."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S
from skillc_runtime.recording.documented import documented

SamplerName: TypeAlias = Literal["tpe", "nsga2", "gp", "random"]
"""How candidates are chosen: tree-structured Parzen estimators, the genetic NSGA-II, Gaussian processes, or chance."""


class LearnSpec(msgspec.Struct, frozen=True, kw_only=True):
    """What is minimised under which constraints, the parameters, how much is tried, and what the result is used for."""

    minimise: Annotated[
        str | None,
        documented(
            "The objectives: figures of trials or expressions over them, between commas.", metavar="EXPRESSIONS"
        ),
    ] = None
    subject_to: Annotated[
        str | None,
        documented(
            "What every trial has to meet, besides its success: comparisons of figures, between commas, such as "
            "`coverage == 100 %, impact <= 2`.",
            metavar="COMPARISONS",
        ),
    ] = None
    parameters: Annotated[
        str | None,
        documented(
            "The parameters that are learned, between commas; by default all with a range, in the library of the task, "
            "whose defaults the task uses.",
            metavar="NAMES",
        ),
    ] = None
    candidates: Annotated[
        Annotated[int, msgspec.Meta(ge=1)],
        documented("How many candidates are tried, the defaults included.", metavar="N"),
    ] = 50
    trials: Annotated[
        Annotated[int, msgspec.Meta(ge=1)],
        documented("The trials of a candidate, each in another world, the same ones for all.", metavar="N"),
    ] = 5
    fresh: Annotated[
        Annotated[int, msgspec.Meta(ge=0)],
        documented("Further worlds, in which the best candidate is compared with the defaults.", metavar="N"),
    ] = 10
    seed: Annotated[Annotated[int, msgspec.Meta(ge=0)], documented("The seed of the first world.", metavar="N")] = 0
    sampler: Annotated[
        SamplerName,
        documented(
            "How candidates are chosen: by tree-structured Parzen estimators, NSGA-II, Gaussian processes (needs torch "
            "and scipy), or at random."
        ),
    ] = "tpe"
    reality: Annotated[
        str | None,
        documented(
            "How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all "
            "imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`.",
            metavar="LEVEL",
        ),
    ] = None
    take: Annotated[
        Annotated[int, msgspec.Meta(ge=0)] | None,
        documented("Propose this candidate of the front, instead of the one that is chosen.", metavar="N"),
    ] = None
    apply: Annotated[bool, documented("Write the learned values into the files of the library.")] = False
    deadline_s: Annotated[
        Annotated[float, msgspec.Meta(ge=1.0)], documented("The time limit of one trial, in wall time.")
    ] = TRIAL_LIMIT_S

    @property
    def expressions(self) -> tuple[str, str]:
        """The texts of objectives and of constraints."""
        return self.minimise or "", self.subject_to or ""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters that are asked for; empty for all."""
        return tuple(name.strip() for name in (self.parameters or "").split(",") if name.strip())


class LearnRequest(
    msgspec.Struct,
    frozen=True,
    kw_only=True,
    tag_field="kind",
    tag="learn",
    omit_defaults=True,
    forbid_unknown_fields=True,
):
    """A task of a cell's library with arguments, from whose trials in the cell's scene parameters are learned.

    `cell` may be left out if there is only one. The texts of the library stay as they are: `spec.apply` is refused.
    """

    cell: str | None = None
    task: str
    arguments: dict[str, str] = {}
    spec: LearnSpec


class LearnResult(msgspec.Struct, frozen=True, kw_only=True, tag_field="kind", tag="learn"):
    """The result of learning: the proposed `values` by parameter, `Skill.implementation.name`, as they are written.

    They are empty if nothing is better than the defaults. `objectives` are means over fresh seeds with the defaults and
    with the values, by the texts of the objectives. `confirmed` is whether no fewer fresh trials meet all constraints
    with the values than with the defaults. `diff` is the change of the texts.
    """

    task: str
    candidates: int
    values: dict[str, str]
    objectives: dict[str, tuple[float, float]]
    confirmed: bool
    diff: str
