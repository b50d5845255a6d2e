"""What two recorded runs have in common and in what they differ. Start at `compare`."""
