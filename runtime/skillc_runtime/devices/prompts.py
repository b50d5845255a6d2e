"""What skills ask operators."""

from __future__ import annotations

import msgspec


class Prompt(msgspec.Struct, frozen=True, kw_only=True):
    """A question of a skill with its choices, and until when, in s of the cell's clock, an operator may answer it.

    The `default` counts then; if it is empty, the skill fails. `id` is the number of the node that asks.
    """

    text: str
    choices: tuple[str, ...]
    ends_s: float
    default: str = ""
    id: int = 0


def find_prompt(prompts: tuple[Prompt, ...], number: int, choice: str) -> Prompt:
    """Return the prompt with a number, 0 for the only one, that has a choice; ValueError if there is none."""
    if not prompts:
        raise ValueError("nothing is asked")
    found = prompts if number == 0 else tuple(each for each in prompts if each.id == number)
    if len(found) != 1:
        listed = "; ".join(f"{each.id}: {each.text}" for each in prompts)
        raise ValueError(f"there is no prompt {number}: {listed}" if number else f"say which prompt: {listed}")
    if choice not in found[0].choices:
        raise ValueError(f"`{choice}` is no choice; there is {', '.join(f'`{each}`' for each in found[0].choices)}")
    return found[0]
