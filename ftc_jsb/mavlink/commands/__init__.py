"""Messages that a ground station sends, and their answers."""
