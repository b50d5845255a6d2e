"""What people start: `cli` is the command line, `lsp` the language server, `services` what both of them do.

Start reading at `cli.main`, then one command in `cli.commands` and the service that it calls.
"""
