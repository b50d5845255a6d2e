"""What watches an arm and its signals, limits its commands and stops it, whichever law controls it."""
