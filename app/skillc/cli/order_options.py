"""The options with which something is started at a time, once or again and again."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from typing import Any, TypeVar

import click

from skillc.cli.options import grouped_option

Function = TypeVar("Function", bound=Callable[..., Any])
ORDER = "Order"


class InstantType(click.ParamType[datetime]):
    """A date and time as of RFC 3339; without an offset it is the time of this machine."""

    name = "time"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> datetime:
        """Return the time with its offset from UTC."""
        try:
            return datetime.fromisoformat(value).astimezone()
        except (ValueError, OverflowError):
            self.fail(f"{value!r} is no time; write it as 2027-01-04T07:00:00 or 2027-01-04T06:00:00Z", param, ctx)


def order_options(function: Function) -> Function:
    """Add `--at`, `--every`, `--until`, `--count` and `--missed`."""
    instant = InstantType()
    options = (
        grouped_option(
            ORDER, "--at", type=instant, metavar="TIME", help="Let the server start it at this time, as RFC 3339."
        ),
        grouped_option(
            ORDER, "--every", type=click.FloatRange(min=1.0), metavar="SECONDS", help="Start it again and again."
        ),
        grouped_option(ORDER, "--until", type=instant, metavar="TIME", help="Start it again until this time."),
        grouped_option(
            ORDER, "--count", type=click.IntRange(min=1), metavar="N", help="Start it this number of times."
        ),
        grouped_option(
            ORDER,
            "--missed",
            type=click.Choice(("run-once", "skip")),
            help="What was not possible within 60 s is started once, as soon as it is (the default), or skipped.",
        ),
    )
    for option in reversed(options):
        function = option(function)
    return function
