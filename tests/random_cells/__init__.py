"""Random cells with parts to sort into bins, half of them with something wrong; start at `spoiling`."""
