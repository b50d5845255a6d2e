"""What crosses a process, as structs without logic, one module a resource; all others stand on it."""
