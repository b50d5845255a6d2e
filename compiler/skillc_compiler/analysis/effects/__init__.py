"""What bodies do: the effects of loops and branches, effects on many, changes of numbers, and how they are declared."""
