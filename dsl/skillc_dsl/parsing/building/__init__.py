"""From the parser's trees to the syntax tree, a page for each page of `skillc_dsl.syntax`."""
