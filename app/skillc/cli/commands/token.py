"""Make, list and revoke the tokens of a server's clients."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command, Group
from skillc.cli.console import page_of, print_json, print_lines, print_remark
from skillc.cli.options import json_option
from skillc.cli.server_completions import complete_token
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.contract.access import Role


@click.group(cls=Group)
def command() -> None:
    """Make, list and revoke the tokens with which clients use a server; this needs the role `admin`."""


@command.command(cls=Command, examples="skillc token add ada --role operate")
@click.argument("name")
@click.option("--role", type=click.Choice(("view", "operate", "edit", "admin")), required=True, help="What it may do.")
@click.option("--agent", is_flag=True, help="For a program that decides by itself: others approve what it submits.")
@server_options
def add(name: str, role: Role, agent: bool) -> None:
    """Make the token NAME and print it; it is not shown again."""
    with connect_server() as server:
        click.echo(server.add_token(name, role, agent))


@command.command("list", cls=Command)
@json_option
@server_options
def list_tokens(as_json: bool) -> None:
    """List the tokens with their roles, without their secrets."""
    import sys

    with connect_server() as server:
        tokens = server.tokens()
    if as_json:
        print_json(tokens)
    else:
        dates = [f"{datetime.fromtimestamp(each.created_ns / 1e9, UTC):%Y-%m-%d}" for each in tokens]
        kinds = [f"{each.role}, agent" if each.agent else each.role for each in tokens]
        rows = [(each.name, kind, date) for each, kind, date in zip(tokens, kinds, dates, strict=True)]
        print_lines(page_of(sys.stdout).columns(rows))


@command.command(cls=Command)
@click.argument("name", shell_complete=complete_token)
@server_options
def revoke(name: str) -> None:
    """Refuse all further requests with the token NAME."""
    with connect_server() as server:
        server.revoke_token(name)
    print_remark(f"{name}: revoked")
