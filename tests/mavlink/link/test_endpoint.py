"""Endpoints as users write them, and their sockets."""

from selectors import DefaultSelector

import pytest

from ftc_jsb.errors import LinkError
from ftc_jsb.mavlink.link.endpoint import Endpoint, open_socket, parse_endpoint
from ftc_jsb.mavlink.link.transport import open_transport
from tests.mavlink.ports import HOST


def test_endpoints_are_read_and_bad_ones_refused():
    assert parse_endpoint("udpin::14550") == Endpoint("udpin", "127.0.0.1", 14550)
    assert not parse_endpoint("tcpin:0.0.0.0:5760").is_local
    for bad in ("udp:127.0.0.1:14550", "udpout:127.0.0.1", "udpin:host:70000", "tcpin:a:b", ""):
        with pytest.raises(LinkError, match="expected udpout"):
            parse_endpoint(bad)
    with open_socket(Endpoint("udpin", HOST, 0)) as first:
        port = first.getsockname()[1]
        with pytest.raises(LinkError, match="in use"):
            open_socket(Endpoint("udpin", HOST, port))


@pytest.mark.parametrize("kind", ["udpin", "tcpin"])
def test_port_0_is_any_that_is_free_and_the_transport_says_which(kind):
    endpoint = parse_endpoint(f"{kind}::0")
    assert endpoint == Endpoint(kind, HOST, 0)
    with DefaultSelector() as selector:
        transport = open_transport(endpoint, selector)
        assert transport.endpoint._replace(port=0) == endpoint
        with pytest.raises(LinkError, match="in use"):
            open_socket(transport.endpoint)
        transport.close()


def test_nothing_is_sent_to_port_0():
    with pytest.raises(LinkError, match="expected udpout"):
        parse_endpoint("udpout::0")
