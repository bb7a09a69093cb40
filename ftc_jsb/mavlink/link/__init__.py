"""Bytes and frames: endpoints, transport, signing, telemetry logs."""
