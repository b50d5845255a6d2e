"""Plans looked at in space: what goes, and why not the rest."""
