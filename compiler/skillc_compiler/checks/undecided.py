"""A body with more possible states than are told apart.

After every node, up to 64 states of the world are followed one by one. Where there are more, only what all of them
have in common is used, so that something may seem not to be guaranteed that is.

Bad:

    use skillc
    skill Tour {
        in a: Surface  in b: Surface  in c: Surface  in d: Surface
        in e: Surface  in f: Surface  in g: Surface  noplan
    }
    impl patient of Tour {
        do seq {
            try { check(a.located == true) }
            try { check(b.located == true) }
            try { check(c.located == true) }
            try { check(d.located == true) }
            try { check(e.located == true) }
            try { check(f.located == true) }
            try { check(g.located == true) }
            wait 1 s
        }
    }

Good:

    use skillc
    skill Tour {
        in a: Surface  in b: Surface  in c: Surface  noplan
    }
    impl patient of Tour {
        do seq {
            try { check(a.located == true) }
            try { check(b.located == true) }
            try { check(c.located == true) }
            wait 1 s
        }
    }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Program
from skillc_compiler.proof.findings import Undecided
from skillc_compiler.proof.proving import found
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("not-decided",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a note for each body that was followed only in part."""
    for one in found(program, Undecided):
        yield Diagnostic(
            "not-decided",
            one.span,
            "this can end in more ways than are followed one by one, so what is told of it may be too careful",
            help="make skills of parts of it",
            severity="warning",
        )
