"""The compiled library: the contract between the compiler and the runtime, which loads nothing else.

Inside are its types, their JSON and PDDL, and the questions that both sides ask of it: how conditions are traversed,
rewritten and formatted, and what skills read and write. Start at `skills.SkillLibrary`.
"""
