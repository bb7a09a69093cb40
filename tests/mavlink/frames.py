"""Frames as the MAVLink library reads them."""

from pymavlink.dialects.v20 import common as dialect


def decoded(frame: bytes):
    return dialect.MAVLink(None).parse_buffer(frame)[0]
