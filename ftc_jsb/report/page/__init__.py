"""The HTML page: its numbers, tables, charts and first screen, from the templates beside them."""
