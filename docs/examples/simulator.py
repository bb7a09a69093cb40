"""Another simulator on the exchange: plain JSBSim, from what `ftc-jsb export f16 DIR --flightgear` wrote.

python simulator.py DIR/f16-ftc 127.0.0.1:5601 5602 70
"""

import socket
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import jsbsim

FRAME, PICTURE = 1.0 / 120.0, 5  # [s]; frames of JSBSim in one of the picture: 24 Hz


def fields(folder: Path, name: str) -> list[str]:
    """Properties of a line, in their order; the check is the last."""
    chunks = ET.parse(folder / "Protocol" / name).iter("chunk")
    return [chunk.findtext("node", "").removeprefix("/fdm/jsbsim/") for chunk in chunks]


def newest(link: socket.socket) -> list[str]:
    """The last line that has come, waiting for one for a moment; without one `ftc_exchange` flies on."""
    line = ""
    try:
        link.settimeout(0.05)  # [s]
        while True:
            line = link.recv(4096).decode()
            link.settimeout(1e-6)
    except OSError:
        return line.split(",") if line else []


folder, where, port, duration = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]), float(sys.argv[4])
fdm = jsbsim.FGFDMExec(None)
fdm.set_debug_level(0)
fdm.set_dt(FRAME)
parts = (str(folder), str(folder / "Engines"), str(folder / "Systems"))
fdm.load_model_with_paths(folder.name, *parts, False)
fdm["ic/h-sl-ft"], fdm["ic/vt-fps"] = 10000.0, 984.25
fdm["ic/lat-geod-deg"], fdm["ic/long-gc-deg"] = 47.0, 8.0
fdm["gear/gear-cmd-norm"] = fdm["gear/gear-pos-norm"] = 0.0
fdm.run_ic()
fdm["propulsion/set-running"] = -1
fdm["simulation/do_simple_trim"] = 1

outgoing, incoming = fields(folder, "ftc-out.xml"), fields(folder, "ftc-in.xml")
link = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
link.bind(("127.0.0.1", port))
there = (where.partition(":")[0], int(where.partition(":")[2]))
while fdm.get_sim_time() < duration:
    line = ",".join(repr(fdm[name]) for name in outgoing)
    link.sendto(line.encode() + b"\n", there)
    for _ in range(PICTURE):  # the answer is in force from the next picture on
        fdm.run()
    numbers = newest(link)
    for name, number in zip(incoming, numbers, strict=False):
        fdm[name] = float(number)  # `ftc_exchange` checks the line and takes what is right
