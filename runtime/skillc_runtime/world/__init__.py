"""What is known of the world: facts, snapshots, transactions, conditions."""
