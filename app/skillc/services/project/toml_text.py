"""Reads TOML within limits: `tomllib` takes time in the square of a key's length, and does not survive every text."""

from __future__ import annotations

import tomllib
from typing import Any

LONGEST = 50_000
"""The most characters of a text: the longest key that fits takes half a second."""


def load_toml(text: str) -> dict[str, Any]:
    """Return the content of a text; ValueError, whose message says why, if it is not TOML or beyond the limits."""
    if len(text) > LONGEST:
        raise ValueError(f"It is longer than {LONGEST:,} characters")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        raise
    except ValueError as error:
        raise ValueError("A number has too many digits") from error
    except RecursionError as error:
        raise ValueError("It is nested too deeply") from error
