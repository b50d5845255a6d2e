"""Opens the text templates of all packages in one way, so that a name that is not given is an error everywhere."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment


def open_templates(*folders: Path, is_html: bool = False, keeps_braces: bool = False) -> Environment:
    """Return the Jinja templates in folders; a name is looked for in one after the other.

    Values are escaped if the templates `is_html`. A line with a block alone is no line of the text. If a template
    `keeps_braces`, since its text has some of its own, `<<` and `<%` stand for those of Jinja.
    """
    # It is slow to import, and most runs of the program write none of these texts.
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    return Environment(
        loader=FileSystemLoader(folders),
        undefined=StrictUndefined,
        autoescape=is_html,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        variable_start_string="<<" if keeps_braces else "{{",
        variable_end_string=">>" if keeps_braces else "}}",
        block_start_string="<%" if keeps_braces else "{%",
        block_end_string="%>" if keeps_braces else "%}",
    )
