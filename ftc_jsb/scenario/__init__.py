"""The scenario file: schema, references, messages."""
