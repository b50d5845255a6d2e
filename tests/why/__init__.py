"""What `skillc why` says of recorded runs."""
