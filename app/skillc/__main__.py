"""`python -m skillc` runs the command `skillc`."""

from skillc.cli.main import main

main()
