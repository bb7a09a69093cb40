"""Whatever comes over the wire, nothing crashes, nothing blocks and the flight's data are unchanged.

The suite sends 6,000 hostile pieces; `make hostile` sends the million (FTC_JSB_HOSTILE).
"""

import math
import os
import random
import struct
import time

import numpy as np
import pytest
from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.recording.columns import ROW
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly
from tests.mavlink.ground import Ground, aloft

PIECES = int(os.environ.get("FTC_JSB_HOSTILE", "6000"))
BATCH = 100  # datagrams that wait in the socket's buffer at a time
KEY = bytes(range(32))
ODD = (math.nan, math.inf, -math.inf, 3.4e38, -0.0, 1e-45)


def whole_frames(chance: random.Random, count: int) -> list[bytes]:
    """Frames that are well made and must do nothing: odd numbers, other systems, any message."""
    mav = dialect.MAVLink(None, 250, 190)
    classes = list(dialect.mavlink_map.values())
    frames = []
    for _ in range(count):
        kind = chance.random()
        if kind < 0.3:  # a command of ours with numbers that are none
            command = chance.choice(list(dialect.enums["MAV_CMD"]))
            params = [chance.choice(ODD[:3]) for _ in range(7)]
            message = dialect.MAVLink_command_long_message(1, 1, command % 65536, 0, *params)
        elif kind < 0.5:  # a command that would act, to another system or component
            other = chance.choice(((9, 1), (1, 154), (255, 0)))
            command = chance.choice((185, 246, 193, 178, 420))
            message = dialect.MAVLink_command_long_message(*other, command, 0, *[1.0] * 7)
        elif kind < 0.6:
            name = chance.choice((b"TRIM_ZETA", b"SYS_FAILURE_EN", b"\xff\x00\xfe", b""))
            value = chance.choice(ODD[:3])
            message = dialect.MAVLink_param_set_message(1, 1, name, value, chance.randrange(256))
        else:  # any message, its payload at random, addressed to nobody here
            made = chance.choice(classes)
            payload = bytearray(chance.randbytes(made.unpacker.size))
            frames.append(_framed(mav, made, _readdressed(made, payload)))
            continue
        frames.append(message.pack(mav))
        mav.seq = (mav.seq + 1) % 256
    return frames


def _readdressed(made, payload: bytearray) -> bytes:
    """A payload whose target system, if it has one, is 77."""
    if "target_system" in made.fieldnames:
        place, index = 0, made.ordered_fieldnames.index("target_system")
        sizes = [struct.calcsize(f"<{code}") for code in made.native_format[1:].decode()]
        for size, length in zip(sizes[:index], made.array_lengths[:index], strict=True):
            place += size * max(length, 1)
        payload[place] = 77
    return bytes(payload)


def _framed(mav, made, payload: bytes) -> bytes:
    head = bytes((len(payload), 0, 0, mav.seq, 250, 190)) + made.id.to_bytes(3, "little")
    crc = dialect.x25crc(head + payload + bytes((made.crc_extra,))).crc
    return b"\xfd" + head + payload + crc.to_bytes(2, "little")


def hostile(chance: random.Random, frames: list[bytes]) -> bytes:
    """A frame as it is, damaged, cut, doubled, or no frame at all."""
    frame = chance.choice(frames)
    kind = chance.randrange(8)
    if kind < 2:
        return frame
    if kind == 2:  # some bits
        damaged = bytearray(frame)
        for _ in range(chance.randrange(1, 4)):
            damaged[chance.randrange(len(damaged))] ^= 1 << chance.randrange(8)
        return bytes(damaged)
    if kind == 3:
        return frame[: chance.randrange(len(frame))]
    if kind == 4:
        return chance.randbytes(chance.randrange(1, 300))
    if kind == 5:  # a length that promises more than there is
        return b"\xfd\xff" + chance.randbytes(chance.randrange(20))
    if kind == 6:  # a message that nobody knows
        number = chance.randrange(60000, 2**24).to_bytes(3, "little")
        return b"\xfd\x04\x00\x00\x00\x01\x01" + number + chance.randbytes(6)
    return frame + chance.choice(frames)[: chance.randrange(40)] + frame


@pytest.mark.parametrize(
    ("stream", "key"), [(False, None), (True, None), (False, KEY)], ids=["udp", "tcp", "signed"]
)
def test_hostile_frames_change_nothing(stream, key, monkeypatch):
    """All are taken in (a ping comes back after each batch) while the paper's flight goes on and on."""
    monkeypatch.setattr("ftc_jsb.mavlink.vehicle.FLOOD_REST", 0.0)  # the ration is tested below
    chance = random.Random(20140101)
    frames = whole_frames(chance, 3000)
    if key is not None:  # what would act, were it signed
        mav = dialect.MAVLink(None, 250, 190)
        acts = dialect.MAVLink_command_long_message(1, 1, 185, 0, *[1.0] * 7)
        frames += [acts.pack(mav)] * 300
    share = PIECES // 3
    kind = "tcpin" if stream else "udpin"
    factor, duration = (8.0, 600) if PIECES < 50_000 else (1.0, 1200)
    with aloft(f"duration={duration}", kind=kind, factor=factor, scenario="paper", key=key) as up:
        ground = Ground(up.port, stream=stream, key=key)
        enemy = ground if stream else Ground(up.port)
        ground.wait_for("ATTITUDE")
        for batch in range(0, share, BATCH):
            for _ in range(min(BATCH, share - batch)):
                enemy.socket.send(hostile(chance, frames))
            if stream:  # so that a frame that was promised and never came is over
                enemy.socket.send(bytes(300))
            ground.send(dialect.MAVLink_ping_message(0, batch, 0, 0))
            ground.wait_for("PING", lambda m, batch=batch: m.seq == batch)
            ground.heard.clear()
            enemy.heard.clear()
        flight = up.land()
        ground.close()
        enemy.close()
    assert [command.kind for _, command in flight.commands] == ["end"]  # ours
    statistics = up.live.statistics
    assert statistics.refused > 0.3 * share
    if not stream:  # none was lost on the way: each datagram is counted, one way or another
        assert statistics.received + statistics.refused >= share
    rows = flight.record.size
    plain = fly(load_scenario("paper", [f"duration={rows / 100.0}"])).record[:rows]
    for name in ROW.names:
        np.testing.assert_array_equal(flight.record[name], plain[name], err_msg=name)


def beats(ground) -> int:
    return sum(m.get_type() == "HEARTBEAT" for m in ground.heard)


def test_flood_is_rationed():
    """Datagrams as fast as they can be sent: the vehicle rests between, and still beats and answers."""
    with aloft() as up:
        ground, enemy = Ground(up.port), Ground(up.port, system=254)
        ground.wait_for("ATTITUDE")
        frame = enemy.frame(dialect.MAVLink_param_request_list_message(1, 1))
        ground.heard.clear()
        until = time.monotonic() + 20.0
        while time.monotonic() < until and not beats(ground):
            for _ in range(20):
                enemy.socket.send(frame)
            ground.listen(0.001)
        assert beats(ground)
        acks: list = []
        while time.monotonic() < until + 20.0 and not acks:  # sent again, as stations do
            ground.command(dialect.MAV_CMD_GET_HOME_POSITION)
            acks = [m for m in ground.listen(0.5) if m.get_type() == "COMMAND_ACK"]
        assert acks
        flight = up.land()
        ground.close()
        enemy.close()
    assert [command.kind for _, command in flight.commands] == ["end"]
