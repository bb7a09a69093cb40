"""The folder for FlightGear: what is in it, whose it is, and that JSBSim flies it without FlightGear."""

import xml.etree.ElementTree as ET

import pytest

from ftc_jsb.aircraft.description import load_aircraft
from ftc_jsb.export.flightgear.aircraft_folder import aircraft_name, export_flightgear
from ftc_jsb.scenario.schema import AircraftChoice
from ftc_jsb.six_dof.exchange.fields import COMMANDED
from tests.cli.command import assert_refused, run
from tests.flightgear.simulated import command, loaded, put


def exported(name, where):
    export_flightgear(load_aircraft(name), AircraftChoice(), where)
    return where / aircraft_name(load_aircraft(name))


@pytest.mark.parametrize("name", ["f16", "f15", "F4N", "A4", "T38"])
def test_jsbsim_flies_it_by_commands(name, tmp_path):
    """The inner loop alone holds 300 m/s for 3 s within 1.5 m/s; then a bank of 30 deg is there 3 s after
    its command, to 1 deg, and the internal tanks are as full as in any flight.
    """
    fdm = loaded(exported(name, tmp_path))
    while fdm.get_sim_time() < 3.0:
        fdm.run()
    assert fdm["ftc/flying"] == 2
    assert fdm["velocities/vt-fps"] * 0.3048 == pytest.approx(300.0, abs=1.5)
    for number in range(1, 73):
        put(fdm, command(fdm, sequence=number, bank_angle_cmd=0.5236, load_factor_cmd=1.15))
        for _ in range(5):
            fdm.run()
    assert fdm["ftc/flying"] == 1
    assert fdm["ftc/bank/actual"] == pytest.approx(0.5236, abs=0.0175)
    tanks = load_aircraft(name).fuel_tanks
    for tank in tanks:
        assert fdm[f"propulsion/tank[{tank}]/pct-full"] == pytest.approx(43.0, abs=2.0)


def test_what_is_in_the_folder(tmp_path):
    """Every XML file can be read; the protocol has the exchange's fields; names of GPL's authors are told."""
    result = run("export", "f16", "f", "--flightgear", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    folder = tmp_path / "f" / "f16-ftc"
    for path in folder.rglob("*.xml"):
        ET.parse(path)
    chunks = ET.parse(folder / "Protocol" / "ftc-in.xml").iter("chunk")
    assert [chunk.findtext("name") for chunk in chunks] == [*(f.name for f in COMMANDED), "check"]
    properties = ET.parse(folder / "f16-ftc-set.xml").getroot()
    assert properties.findtext("sim/aero") == "f16-ftc"
    dialog = properties.findtext("sim/menubar/default/menu/item/binding/dialog-name")
    assert ET.parse(folder / "gui/dialogs" / f"{dialog}.xml").getroot().findtext("name") == dialog
    nasal = (folder / "Nasal" / "ftc.nas").read_text(encoding="utf-8")
    assert '["healthy", "thrust", ' in nasal
    assert nasal.count("var hypotheses = ") == 1
    notice = (tmp_path / "f" / "NOTICE").read_text(encoding="utf-8")
    assert "Erik Hofman" in notice
    assert "f16-ftc/f16-ftc.xml" in notice.partition("COPIED")[0]
    assert "f16-ftc/Systems/hook.xml" in notice.partition("COPIED")[2]
    assert "ftc_exchange" not in notice.partition("CHANGED")[2]
    assert_refused(run("export", "f16", "f", "--flightgear", cwd=tmp_path), "is not empty")
