"""What can be asked of skillc, without a terminal: check, compile, plan, run and more, as functions and values."""
