"""Completion for bash, which takes `=` and `:` for ends of words: a name after them is completed all the same."""

from __future__ import annotations

import os
from typing import ClassVar

from click.shell_completion import BashComplete, CompletionItem, add_completion_class, split_arg_string

BREAKS = "=:"
"""The characters of arguments at which bash begins another word."""
SOURCE = """\
%(complete_func)s() {
    local type value
    COMPREPLY=()
    while IFS=',' read -r type value; do
        case $type in
            dir) compopt -o dirnames ;;
            file) compopt -o default ;;
            plain)
                [[ $value == *= ]] && compopt -o nospace
                COMPREPLY+=("$value") ;;
        esac
    done < <(env COMP_LINE="${COMP_LINE:0:COMP_POINT}" %(complete_var)s=bash_complete "$1")
}

complete -o nosort -F %(complete_func)s %(prog_name)s
"""


class BashCompletion(BashComplete):
    """Completes the line up to the cursor, and offers what replaces its last word in the sense of bash."""

    source_template: ClassVar[str] = SOURCE

    def get_completion_args(self) -> tuple[list[str], str]:
        """Return the arguments before the cursor, and the one at it, which may be empty."""
        line = os.environ["COMP_LINE"]
        words = split_arg_string(line)[1:]
        return (words, "") if not words or line[-1].isspace() else (words[:-1], words[-1])

    def format_completion(self, item: CompletionItem[str]) -> str:
        """Return the kind and the text of what is offered, for the script."""
        _, begun = self.get_completion_args()
        kept = 1 + max(begun.rfind(each) for each in BREAKS)
        return f"{item.type},{item.value[kept:]}"


def use_completion() -> None:
    """Let click complete for bash by this."""
    add_completion_class(BashCompletion)
