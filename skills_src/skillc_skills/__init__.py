"""The skill libraries that ship with skillc. Start at `std/handling.skill` and `wiping/wipe.skill`."""
