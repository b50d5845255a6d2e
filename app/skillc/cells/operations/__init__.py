"""The operations of a cell: from what is requested to what is recorded."""
