"""Jobs: work for cells that takes its time. A kind is a file in `kinds`, with how it is checked, and how it is done."""
