"""docs/mavlink.md says what the program does: messages, rates, numbers, parameters and their ranges."""

import re
from pathlib import Path

from pymavlink.dialects.v20 import common as dialect

from ftc_jsb.mavlink.commands import parameters
from ftc_jsb.mavlink.commands.command_protocol import CommandProtocol
from ftc_jsb.mavlink.telemetry.message_streams import STREAMS
from ftc_jsb.mavlink.telemetry.outer_loop_messages import OUTER_LOOP_VALUES
from ftc_jsb.scenario.load import load_scenario

TEXT = (Path(__file__).parents[2] / "docs" / "mavlink.md").read_text()


def row(name):
    return next(line for line in TEXT.splitlines() if re.match(rf"\|[^|]*\b{name}\b", line))


def test_every_message_is_listed_with_its_rate():
    for stream in STREAMS:
        rate = row(stream.message.msgname).split("|")[2].strip()
        assert rate == (f"{stream.rate:g}" if stream.rate else "on request")


def test_every_number_is_listed():
    for named in OUTER_LOOP_VALUES:
        assert named.unit in row(named.name), named.name


def test_every_parameter_is_listed_and_the_links_with_range_and_default():
    groups = (
        parameters.TRACKING_GAINS, parameters.INTEGRAL_GAINS, parameters.PATH_GAINS, parameters.EVERY_LOOP,
        parameters.DETECTOR, parameters.COVARIANCES, parameters.RESPONSE_TIME,
    )  # fmt: skip
    for parameter in (p for group in groups for p in group):
        assert row(parameter.name)
        assert len(parameter.name) <= 16
    for parameter in parameters.LINK_PARAMETERS:
        line = row(parameter.name)
        word = "or" if parameter.whole else "to"
        assert f"{parameter.low:g} {word} {parameter.high:g} ({parameter.default:g})" in line


def test_every_command_is_listed():
    class Nobody:
        scenario = load_scenario("paper")

    listed = set()
    for line in TEXT.splitlines():
        if line.startswith("| MAV_CMD_"):
            names = line.split("|")[1].replace(" ", "").split(",")
            listed |= {n if n.startswith("MAV_CMD") else f"MAV_CMD{n}" for n in names}
    handled = {dialect.enums["MAV_CMD"][n].name for n in CommandProtocol(Nobody()).handlers}
    assert listed == handled
