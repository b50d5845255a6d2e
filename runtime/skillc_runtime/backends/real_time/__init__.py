"""A cell whose control periods run by the wall clock, in a thread of their own; `cell` has it all."""
