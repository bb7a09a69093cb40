"""Long flights and many flights: what docs/validation.md reports. `make validate` runs it."""
