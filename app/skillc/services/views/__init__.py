"""What is shown of scenes, skills, tasks and plans: lists, answers to queries, exports and drawings."""
