"""Words that every room shares: channels, engines, surfaces, signals, quantities."""
