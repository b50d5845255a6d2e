"""What is asked about recorded runs, and what is answered."""
