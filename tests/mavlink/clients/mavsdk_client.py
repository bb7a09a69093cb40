"""What a MAVSDK program sees and does; prints it as JSON. Run by test_mavsdk.py beside a real flight.

usage: mavsdk_client.py PORT
"""

import asyncio
import json
import sys
import time

from mavsdk.asyncio import ComponentType, Configuration, Mavsdk
from mavsdk.asyncio.plugins.action import ActionAsync
from mavsdk.asyncio.plugins.failure import FailureAsync
from mavsdk.asyncio.plugins.mavlink_direct import MavlinkDirectAsync
from mavsdk.asyncio.plugins.param import ParamAsync
from mavsdk.asyncio.plugins.telemetry import TelemetryAsync
from mavsdk.plugins.failure import FailureType, FailureUnit

seen: dict[str, object] = {}
texts: list[str] = []
named: dict[str, list[float]] = {}


async def timed(name, coroutine):
    """Result of a call, or its error, and how long it took."""
    started = time.monotonic()
    try:
        result = await asyncio.wait_for(coroutine, 10.0)
        seen[name] = "done" if result is None else result
    except Exception as error:
        seen[name] = f"{type(error).__name__}: {error}"
    seen[f"{name}_s"] = time.monotonic() - started


async def first(stream, wanted=lambda value: True, within=30.0):
    async def look():
        async for value in stream:
            if wanted(value):
                return value
        raise EOFError

    return await asyncio.wait_for(look(), within)


async def collect_texts(telemetry):
    async for text in telemetry.subscribe_status_text():
        texts.extend([text.text])


async def collect_named(direct):
    async for message in direct.subscribe_message("NAMED_VALUE_FLOAT"):
        fields = json.loads(message.fields_json)
        named.setdefault(fields["name"].rstrip("\0"), []).append(fields["value"])


async def main(port):
    mavsdk = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
    await mavsdk.add_any_connection(f"udpin://127.0.0.1:{port}")
    started = time.monotonic()
    system = await mavsdk.first_autopilot(60.0)
    seen["discovered"] = system is not None
    seen["discovery_s"] = time.monotonic() - started
    telemetry, param = TelemetryAsync(system), ParamAsync(system)
    failure, action = FailureAsync(system), ActionAsync(system)
    direct = MavlinkDirectAsync(system)
    tasks = [
        asyncio.create_task(collect_texts(telemetry)),
        asyncio.create_task(collect_named(direct)),
    ]
    await first(telemetry.subscribe_in_air(), bool, 180.0)  # kernels may have to be compiled
    seen["in_air"] = True
    await first(telemetry.subscribe_health_all_ok(), bool)
    seen["health_all_ok"] = True
    seen["armed"] = await first(telemetry.subscribe_armed(), bool)
    position = await first(telemetry.subscribe_position())
    seen["position"] = [
        position.latitude_deg, position.longitude_deg,
        position.absolute_altitude_m, position.relative_altitude_m,
    ]  # fmt: skip
    angles = await first(telemetry.subscribe_attitude_euler())
    seen["attitude"] = [angles.roll_deg, angles.pitch_deg, angles.yaw_deg]
    hud = await first(telemetry.subscribe_fixedwing_metrics(), lambda m: m.airspeed_m_s > 1.0)
    seen["hud"] = [hud.airspeed_m_s, hud.throttle_percentage, hud.climb_rate_m_s]
    truth = await first(telemetry.subscribe_ground_truth())
    seen["truth"] = [truth.latitude_deg, truth.longitude_deg, truth.absolute_altitude_m]

    await timed("gain", param.get_param_float("GAIN_SPD"))
    await timed("unknown", param.get_param_float("NO_SUCH_PARAM"))
    await timed("too_large", param.set_param_float("FAIL_EFF", 1.5))
    await timed("gain_set", param.set_param_float("GAIN_SPD", 1.5))
    await timed("gain_read", param.get_param_float("GAIN_SPD"))
    await timed("list", param.get_all_params())
    listed = seen.pop("list")
    seen["listed"] = {p.name: p.value for p in listed.float_params}

    await timed("inject_locked", failure.inject(FailureUnit.SYSTEM_MOTOR, FailureType.SLOW, 1))
    await timed("enable", param.set_param_float("SYS_FAILURE_EN", 1.0))
    await timed("severity", param.set_param_float("FAIL_EFF", 0.7))
    await timed("inject", failure.inject(FailureUnit.SYSTEM_MOTOR, FailureType.SLOW, 1))
    await timed("inject_again", failure.inject(FailureUnit.SYSTEM_MOTOR, FailureType.SLOW, 1))
    await timed("inject_none", failure.inject(FailureUnit.SENSOR_OPTICAL_FLOW, FailureType.OFF, 1))
    await asyncio.sleep(3.0)
    seen["estimate"] = named["EFF_THR"][-1]
    await timed("heal", failure.inject(FailureUnit.SYSTEM_MOTOR, FailureType.OK, 1))
    await timed("speed", action.set_current_speed(295.0))
    await timed("disarm", action.disarm())
    await asyncio.sleep(3.0)
    seen["estimate_healed"] = named["EFF_THR"][-1]
    await timed("terminate", action.terminate())
    await first(telemetry.subscribe_armed(), lambda armed: not armed)
    seen["disarmed_at_the_end"] = True
    await timed("shutdown", action.shutdown())
    for task in tasks:
        task.cancel()
    print(json.dumps({**seen, "texts": texts, "named": sorted(named)}), flush=True)


if __name__ == "__main__":
    asyncio.run(main(int(sys.argv[1])))
