"""The point mass: equations, tables, plant."""
