"""What runs in the process that controls an arm, each period."""
