"""MAVLink 2 frames from plain values: what does not fit a field is clamped and counted, never raised."""

import math
import time
from collections.abc import Mapping
from functools import cache
from typing import Any

from pymavlink.dialects.v20 import common as dialect

COMPONENT = dialect.MAV_COMP_ID_AUTOPILOT1
EPOCH = 1_420_070_400  # [s], Unix time of 2015-01-01, from which signatures count
TICK = 1e-5  # [s], of a signature's time stamp
LARGEST_FLOAT = 3.4028234e38  # of 32 bits

_BITS = {f"{sign}int{size}_t": (sign == "", size) for sign in ("", "u") for size in (8, 16, 32, 64)}
_BITS["uint8_t_mavlink_version"] = (False, 8)


@cache
def _field_formats(message: type[Any]) -> tuple[tuple[str, str, int, int, int], ...]:
    """Name, kind, array length, least and greatest of each field of a message."""
    lengths = dict(zip(message.ordered_fieldnames, message.array_lengths, strict=True))
    formats = []
    for name, kind in zip(message.fieldnames, message.fieldtypes, strict=True):
        low, high = 0, 0
        if kind in _BITS:
            signed, size = _BITS[kind]
            low, high = (-(2 ** (size - 1)), 2 ** (size - 1) - 1) if signed else (0, 2**size - 1)
        formats.append((name, kind, lengths[name], low, high))
    return tuple(formats)


class Encoder:
    """Frames of one vehicle: its identity, sequence and signature."""

    def __init__(self, system: int, key: bytes | None = None) -> None:
        """Args: system id, 1 to 255; secret key of 32 bytes if frames are to be signed."""
        self.clamped = 0  # values that did not fit
        self._mav = dialect.MAVLink(None, system, COMPONENT)
        if key is not None:
            self._mav.signing.secret_key = key
            self._mav.signing.sign_outgoing = True

    def frame(self, message: type[Any], fields: Mapping[str, Any]) -> bytes:
        """A frame of `message` with `fields`, in units of the message; fields that are left out are 0."""
        mav = self._mav
        if mav.signing.sign_outgoing:
            mav.signing.timestamp = max(mav.signing.timestamp, signing_time())
        packed: bytes = message(**self._clamped_fields(message, fields)).pack(mav)
        mav.seq = (mav.seq + 1) % 256
        return packed

    def _clamped_fields(self, message: type[Any], fields: Mapping[str, Any]) -> dict[str, Any]:
        values: dict[str, Any] = {}
        for name, kind, length, low, high in _field_formats(message):  # type: ignore[arg-type]
            value = fields.get(name, b"" if kind == "char" else 0)
            if kind == "char":
                values[name] = value.encode("ascii", "replace") if isinstance(value, str) else value
                values[name] = values[name][:length]
            elif length and not isinstance(value, int | float):
                filled = [self._clamped_number(v, low, high) for v in value[:length]]
                values[name] = filled + [0] * (length - len(filled))
            elif length:
                values[name] = [self._clamped_number(value, low, high)] * length
            else:
                values[name] = self._clamped_number(value, low, high)
        return values

    def _clamped_number(self, value: float, low: int, high: int) -> float:
        if high == 0:  # a float
            if -LARGEST_FLOAT <= value <= LARGEST_FLOAT or not math.isfinite(value):
                return value
            self.clamped += 1
            return math.copysign(LARGEST_FLOAT, value)
        if not math.isfinite(value):
            self.clamped += 1
            return high if value == math.inf else low if value == -math.inf else 0
        whole = round(value)
        if low <= whole <= high:
            return whole
        self.clamped += 1
        return low if whole < low else high


def signing_time() -> int:
    """Now as the time stamp of a signature."""
    return int((time.time() - EPOCH) / TICK)
