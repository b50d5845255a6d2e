"""The programs that people start: `cli` is the command line, `lsp` the language server, `services` what both share.

Start at `cli.main`, then read one command in `cli.commands` and the service that it calls.
"""
