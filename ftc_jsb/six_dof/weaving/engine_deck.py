"""The engines' part of the weaving: effectiveness at the thrust tables, deck, throttle of each."""

import copy
import xml.etree.ElementTree as ET

from ftc_jsb.errors import AircraftError
from ftc_jsb.six_dof.weaving.elements import constant, operation, property_value, required

EFFECTIVENESS = "ftc/effectiveness/engine"  # one a engine: [0], [1]; 1 = healthy


def thrust_tables(engine: ET.Element, name: str) -> dict[str, ET.Element]:
    """Healthy idle, military and maximum thrust [lbs] as JSBSim functions of the engine's tables.

    Bleed air takes its share of the dry thrust; JSBSim's reheat makes up for it.
    """
    if engine.tag != "turbine_engine":
        kind = engine.tag.replace("_", " ")
        article = "an" if kind[0] in "aeiou" else "a"
        raise AircraftError(f"{name}.xml: {article} {kind}; only turbine engines can be woven")
    tables = {f.get("name"): f[0] for f in engine.findall("function") if len(f)}
    for function in ("IdleThrust", "MilThrust"):
        if function not in tables:
            raise AircraftError(f"{name}.xml: no function {function!r}; the thrust deck needs it")
    military = repr(float(required(engine, "milthrust").text or "") * (1.0 - _bleed(engine)))
    idle = operation("product", constant(military), tables["IdleThrust"])
    spread = operation("difference", constant("1"), tables["IdleThrust"])
    dry = operation("sum", tables["IdleThrust"], operation("product", spread, tables["MilThrust"]))
    decks = {"idle": idle, "military": operation("product", constant(military), dry)}
    decks["maximum"] = decks["military"]
    if has_reheat(engine):
        maximum = required(engine, "maxthrust").text or ""
        decks["maximum"] = operation("product", constant(maximum), tables["AugThrust"])
    return decks


def _bleed(engine: ET.Element) -> float:
    return float(engine.findtext("bleed", "0"))


def apply_effectiveness(engine: ET.Element) -> None:
    """Multiply the thrust tables by the effectiveness k, so that thrust is k times the healthy one.

    JSBSim adds to idle thrust i the military part (1 - i) m, so m takes k (1 - i) / (1 - k i) in
    place of k.
    """
    effectiveness = ET.Element("property")
    effectiveness.text = f"{EFFECTIVENESS}[#]"  # JSBSim puts the engine's number for #
    tables = {f.get("name"): (f, f[0]) for f in engine.findall("function") if len(f)}
    idle = tables["IdleThrust"][1]
    for name in ("IdleThrust", "MilThrust", "AugThrust"):
        if name not in tables:
            continue
        function, table = tables[name]
        factors = [effectiveness, table]
        if name == "MilThrust":
            lost = operation("product", effectiveness, idle)
            factors.append(
                operation(
                    "quotient",
                    operation("difference", constant("1"), idle),
                    operation("difference", constant("1"), lost),
                )
            )
        function.remove(table)
        function.append(operation("product", *factors))


def deck_system(decks: list[dict[str, ET.Element]]) -> ET.ElementTree:
    """A JSBSim system that declares the effectiveness of each engine and publishes the deck."""
    system = ET.Element("system", name="ftc engine deck")
    for number in range(len(decks)):
        declared = ET.SubElement(system, "property", value="1")
        declared.text = f"{EFFECTIVENESS}[{number}]"
    channel = ET.SubElement(system, "channel", name="engine deck")
    for level in ("idle", "military", "maximum"):
        function = ET.SubElement(channel, "fcs_function", name=f"ftc/deck/{level}-lbs")
        total = [deck[level] for deck in decks]
        level_total = operation("sum", *total) if len(total) > 1 else copy.deepcopy(total[0])
        ET.SubElement(function, "function").append(level_total)
    return ET.ElementTree(system)


def throttle_system(engines: list[ET.Element], name: str, military: float) -> ET.ElementTree:
    """A JSBSim system that takes `ftc/throttle` to each engine once the inner loop is engaged.

    Args:
        engines: XML of each engine, as it is woven.
        name: of the property to write, `[k]` added.
        military: its value at military thrust.
    """
    system = ET.Element("system", name="ftc throttles")
    channel = ET.SubElement(system, "channel", name="throttles")
    for number, engine in enumerate(engines):
        throttle = property_value("ftc/throttle")
        if not has_reheat(engine):  # JSBSim would spool it beyond its maximum
            throttle = operation("min", constant("1"), throttle)
        elif engine.findtext("augmethod", "0").strip() == "1":
            throttle = _switched()
        wanted = operation("product", constant(repr(military)), throttle)
        engaged = operation("gt", property_value("ftc/engaged"), constant("0.5"))
        held = operation("ifthen", engaged, wanted, property_value(f"{name}[{number}]"))
        function = ET.SubElement(channel, "fcs_function", name=f"ftc/throttle-{number}")
        ET.SubElement(function, "function").append(held)
        ET.SubElement(function, "output").text = f"{name}[{number}]"
    return ET.ElementTree(system)


def has_reheat(engine: ET.Element) -> bool:
    """Whether the throttle lights reheat: in JSBSim not where `augmethod` is 0, a switch apart."""
    tables = [function.get("name") for function in engine.findall("function")]
    fitted = engine.findtext("augmented", "0").strip() == "1"
    return "AugThrust" in tables and fitted and engine.findtext("augmethod", "0").strip() != "0"


def _switched() -> ET.Element:
    """Throttle of a reheat that JSBSim lights in full above 0.99: whichever thrust is nearer."""
    lit = operation("gt", property_value("ftc/thrust/reheat-fraction"), constant("0.5"))
    dry = operation("min", constant("0.985"), property_value("ftc/throttle"))
    return operation("ifthen", lit, constant("1"), dry)
