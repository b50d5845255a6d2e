"""`python -m skillc` is the command `skillc`."""

from skillc.cli.main import main

main()
