"""What Python programs pass and get, whether the work is done here (`api`) or by a server (`client`)."""
