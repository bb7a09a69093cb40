"""What a recording says of itself in the attributes of its file: scenario, versions, outcome, commands."""

import json
from typing import Any

import ftc_jsb
from ftc_jsb.recording.commands import commands_json
from ftc_jsb.recording.flight import Flight
from ftc_jsb.recording.provenance import aircraft_digest, machine, versions
from ftc_jsb.scenario.load import scenario_toml


def attributes(flight: Flight) -> dict[str, Any]:
    """What a recording says of itself."""
    scenario = flight.scenario
    return {
        "title": scenario.title or scenario.name,
        "source": f"ftc-jsb {ftc_jsb.__version__}",
        "model": scenario.model,
        "loop": scenario.loop.name,
        "seed": scenario.seed,
        "outer_loop_rate_hz": scenario.loop.rate,
        "jsbsim_rate_hz": scenario.loop.rate * scenario.simulation.jsbsim_steps,
        "scenario": scenario_toml(scenario),
        "versions": json.dumps(versions()),
        "machine": machine(),
        "aircraft_digest": aircraft_digest(scenario),
        "status": flight.outcome.status,
        "end_time_s": flight.outcome.time,
        "reason": flight.outcome.reason,
        "commands": commands_json(flight.commands),
    }
