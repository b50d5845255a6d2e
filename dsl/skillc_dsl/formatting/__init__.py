"""The formatter of `.skill` files: the parse tree is converted to a document, which is laid out in lines.

Start at `formatter.format_source`.
"""
