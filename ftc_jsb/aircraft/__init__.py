"""The typed `aircraft.toml` and flight conditions that follow from it."""
