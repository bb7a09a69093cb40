"""Messages that a ground station sends, what they do and how they are acknowledged."""
