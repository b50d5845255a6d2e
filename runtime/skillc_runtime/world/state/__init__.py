"""What is known of the world: immutable versions, how they change, which axioms they obey. Start at `world_state`."""
