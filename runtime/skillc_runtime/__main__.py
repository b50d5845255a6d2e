"""`python -m skillc_runtime` is `skillc`."""

from skillc_runtime.commands.main import main

main()
