"""Asks an operator."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

MAX_CHOICES = 9
"""So many keys of a keyboard choose."""


class Ask(Primitive):
    """Shows a text with choices, which are separated by `|`, and waits for an answer for up to `limit` s.

    The output `answer` is what was chosen, or `default` if nobody has answered.
    """

    moves = NOTHING
    stays_put = True
    uses_devices = False

    def __init__(self, cell: Cell, *, text: str, choices: str, default: str | None, limit: float) -> None:
        super().__init__(cell)
        self._text, self._choices, self._default, self._limit = text, split_choices(choices), default or "", limit
        self._answer = ""

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        """Return what is wrong with the choices."""
        choices, default = arguments.get("choices"), arguments.get("default")
        if not isinstance(choices, str):
            return None
        found = split_choices(choices)
        if not 2 <= len(found) <= MAX_CHOICES or "" in found or len(set(found)) < len(found):
            return f'`choices` has 2 to {MAX_CHOICES} different texts, such as "yes | no"; it is "{choices}"'
        if isinstance(default, str) and default not in found:
            return f'the default "{default}" is none of the choices "{choices}"'
        return None

    def start(self) -> None:
        """Show the prompt."""
        self.prompt = Prompt(
            text=self._text, choices=self._choices, default=self._default, ends_s=self.cell.now + self._limit
        )

    def answer(self, choice: str) -> None:
        """Take what an operator has chosen."""
        self._answer = choice

    def tick(self) -> Status:
        """Return SUCCESS once there is an answer; SkillFailure if nobody answers and there is no default."""
        assert self.prompt is not None, "it has started"
        if not self._answer and self.cell.now < self.prompt.ends_s:
            return Status.RUNNING
        if not self._answer and not self._default:
            raise SkillFailure(
                'nobody has answered "{text}" within {limit}', text=self._text, limit=LabelledQuantity(self._limit, "s")
            )
        self.outputs["answer"] = self._answer or self._default
        self.prompt = None
        return Status.SUCCESS


class AskOutcome(Ask):
    """Asks what has come of its skill: the labels of its outcomes are the choices, and the answer counts as reported.

    It takes a `text`, may take a `default` and a `limit` in s, and further parameters, which the outcomes are about.
    """

    outcome_evidence = "reported"

    def __init__(
        self, cell: Cell, *, text: str, default: str | None = None, limit: float = 300.0, **about: object
    ) -> None:
        super().__init__(cell, text=text, choices="", default=default, limit=limit)

    def start(self) -> None:
        """Show the prompt; SkillFailure if the default is no outcome that may come."""
        self._choices = self.outcomes
        if self._default and self._default not in self._choices:
            raise SkillFailure(f'the default "{self._default}" is none of {", ".join(self._choices)}')
        super().start()

    def tick(self) -> Status:
        """Return SUCCESS once there is an answer, which is the outcome; SkillFailure as `Ask`."""
        status = super().tick()
        if status is Status.SUCCESS:
            self.outcome = str(self.outputs.pop("answer"))
        return status


def split_choices(text: str) -> tuple[str, ...]:
    """Return the choices in a text, which `|` separates."""
    return tuple(each.strip() for each in text.split("|"))
