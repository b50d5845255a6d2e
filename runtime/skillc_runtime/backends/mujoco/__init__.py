"""The simulated cell: from what the world model says to a MuJoCo model, its devices, its recording and its metrics."""
