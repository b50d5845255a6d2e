"""A command whose options are made from the fields of a struct: names, limits, help; its function gets the struct."""

from __future__ import annotations

from typing import Annotated, Literal

import click
import msgspec
import pytest
from click.testing import CliRunner

from skillc.cli.struct_options import struct_options
from skillc_runtime.recording.documented import documented


class Cooking(msgspec.Struct, frozen=True, kw_only=True):
    """How something is cooked, and for whom."""

    guests: tuple[str, ...] = ()
    dish: str = ""
    limit_s: Annotated[Annotated[float, msgspec.Meta(gt=0.0)] | None, documented("Stop after this time.")] = None
    portions: Annotated[int, msgspec.Meta(ge=1), documented("For so many people.", metavar="N")] = 4
    stove: Annotated[Literal["gas", "wood"], documented("What it is cooked on.")] = "gas"
    spices: Annotated[tuple[str, ...], documented("Add a spice.", metavar="SPICE")] = ()
    salted: Annotated[bool, documented("Add salt.")] = True
    spicy: Annotated[bool, documented("Add pepper.")] = False


@click.command()
@click.argument("dish")
@click.option("--loud", is_flag=True)
@struct_options(Cooking, without=("spicy",))
def cook(cooking: Cooking, loud: bool) -> None:
    """Cook something."""
    click.echo(f"{cooking}{'!' * loud}")


WORDS = (
    "soup",
    "--limit",
    "2.5",
    "--portions",
    "2",
    "--stove",
    "wood",
    "--spices",
    "a",
    "--spices",
    "b",
    "--no-salted",
)


def test_the_function_gets_the_struct_whole_and_its_own_options_beside_it() -> None:
    done = CliRunner().invoke(cook, [*WORDS, "--loud"])
    wanted = Cooking(dish="soup", limit_s=2.5, portions=2, stove="wood", spices=("a", "b"), salted=False)
    assert (done.output, done.exit_code) == (f"{wanted}!\n", 0)


def test_what_is_not_given_is_as_the_struct_says() -> None:
    assert CliRunner().invoke(cook, ["soup"]).output == f"{Cooking(dish='soup')}\n"


@pytest.mark.parametrize(
    "words", [("--limit", "0"), ("--portions", "0"), ("--stove", "oil"), ("--spicy",), ("--guests", "Ada")]
)
def test_limits_are_those_of_the_fields_and_only_documented_ones_are_options(words: tuple[str, ...]) -> None:
    assert CliRunner().invoke(cook, ["soup", *words]).exit_code == 2


def test_the_help_is_what_the_fields_say() -> None:
    shown = " ".join(CliRunner().invoke(cook, ["--help"]).output.split())
    for each in (
        "--limit SECONDS Stop after this time. [x>0.0]",
        "--portions N For so many people. [default: 4; x>=1]",
        "--stove [gas|wood] What it is cooked on. [default: gas]",
        "--spices SPICE Add a spice. Can be repeated.",
        "--salted / --no-salted Add salt.",
    ):
        assert each in shown, shown
