"""The language server: the protocol around `skillc_compiler.ide`, and the state of the libraries being edited.

Start at `server`, which maps each request to its handler, and `session`, the state of one editor's session.
"""
