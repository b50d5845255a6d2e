"""Learns parameters of skills from trials: `coordinator.learn` asks for candidates, tries them, and keeps the study."""
