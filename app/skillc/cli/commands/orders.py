"""List or remove the orders of a cell: what its server starts at a time, once or again and again.

`skillc start --at TIME` makes an order.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.console import page_of, print_json, print_lines, print_remark
from skillc.cli.options import json_option
from skillc.cli.server_access import cell_option
from skillc.cli.server_completions import complete_order
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.cli.layout import Row
    from skillc.contract.order import Order

EXAMPLES = """
skillc orders
skillc orders --remove clean_table-20270104T060000Z-1f0c9a
"""


@click.command(cls=Command, examples=EXAMPLES)
@cell_option
@click.option(
    "--remove", metavar="ORDER", shell_complete=complete_order, help="Forget this order; what it has started goes on."
)
@json_option
@server_options
def command(cell: str | None, remove: str | None, as_json: bool) -> None:
    """List the orders of a cell: id, task, who made it, when it starts next, and why the last start failed or waits."""
    with connect_server() as server:
        place = server.cell(cell)
        if remove is not None:
            place.remove_order(remove)
            print_remark(f"{remove}: removed")
            return
        orders = place.orders()
    if as_json:
        print_json(orders)
    else:
        print_lines(page_of(sys.stdout).columns([_row(each) for each in orders]))


def _row(order: Order) -> Row:
    request, every_s = order.order.request, order.order.every_s
    what = request.task or request.goal or request.call or ""
    when = "ended" if order.next_at is None else f"{order.next_at:%Y-%m-%d %H:%M:%SZ}"
    again = f"every {every_s:g} s" if every_s else "once"
    return order.id, what, order.owner, when, again, order.reason or order.operation or ""
