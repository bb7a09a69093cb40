"""Numbers from flights: metrics, limits, residuals, validity, the proof along a flight."""
