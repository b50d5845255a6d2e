"""Space: who is placed in whose frame, where that makes everything, and what follows from it about two things."""
