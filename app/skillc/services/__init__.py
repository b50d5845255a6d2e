"""The application logic, without a terminal: check, compile, plan, run and more. Commands and editors call it.

Start at `checking` for check, `artifacts` for compile, `task_loading` with `planning` and `running` for plan and run.
Services report through `reporting.Reporter` and fail with the exceptions in `errors`.
"""
