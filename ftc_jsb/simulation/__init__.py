"""Flying, recording, limits."""
