"""The one layout of a `.skill` file: the parser's tree becomes a document, the document becomes lines.

Start at `formatter.format_source`.
"""
