"""What really happens in a simulated cell: contacts, touches, motion of tools; for reports and trials."""
