# FlightGear's side of the outer loop: what the dialog shows and does, and the pilot's stick as references.
# Who flies is decided in JSBSim (Systems/ftc_exchange.xml), frame by frame; here is only what people see.

var ftc = "/fdm/jsbsim/ftc/";
var get = func(name) { getprop(ftc ~ name) or 0 };
var set = func(name, value) { setprop(ftc ~ name, value) };
var DEGREES = 180 / math.pi;
var DEAD = 0.02; # of stick and lever
var PERIOD = 0.1; # [s]

# Kind of a fault in the dialog: part, and its state; "" where the slider's effectiveness is what is left.
var faults = {
    "thrust lost": ["engine-0", ""], "second engine's thrust lost": ["engine-1", ""],
    "engine out": ["engine-0", 1], "second engine out": ["engine-1", 1],
    "throttle stuck": ["engine-0", 2],
    "elevator lost": ["elevator", ""], "aileron lost": ["aileron", ""], "rudder lost": ["rudder", ""],
    "elevator stuck": ["elevator", 2], "aileron stuck": ["aileron", 2], "rudder stuck": ["rudder", 2],
};

var inject = func {
    var fault = faults[getprop("/ftc/dialog/kind") or ""];
    if (fault == nil) return;
    var left = getprop("/ftc/dialog/left");
    var out = fault[1] == 1;
    set("dialog/" ~ fault[0] ~ "-effectiveness", fault[1] == "" ? left : (out ? 0 : 1));
    set("dialog/" ~ fault[0] ~ "-state", fault[1] == "" ? 0 : fault[1]);
    screen.log.write("fault: " ~ getprop("/ftc/dialog/kind"), 1, 0.5, 0.2);
}

var repair = func {
    foreach (var part; ["engine-0", "engine-1", "engine-2", "engine-3", "elevator", "aileron", "rudder"]) {
        set("dialog/" ~ part ~ "-effectiveness", 1);
        set("dialog/" ~ part ~ "-state", 0);
    }
    screen.log.write("faults repaired", 0.5, 1, 0.5);
}

# The pilot takes the references, or gives them back; stick and lever count from where they are now.
var zero = {roll: 0, pitch: 0, lever: 0};
var stick = {
    roll: func { getprop("/controls/flight/aileron") or 0 },
    pitch: func { -(getprop("/controls/flight/elevator") or 0) },
    lever: func { 4 * (getprop("/controls/engines/engine/throttle") or 0) },
};

var had = 0;

var hand_over = func { set("pilot/wanted", get("pilot/wanted") ? 0 : 1); }

var switch_outer_loop = func { set("outer-loop/on", get("outer-loop/on") ? 0 : 1); }

# Steps of a reference from the dialog's buttons.
var step = func(name, by) {
    if (get("pilot/has")) set("pilot/" ~ name, get("pilot/" ~ name) + by);
}

var who = func {
    var flying = get("flying");
    if (flying == 0) return "nobody: not yet in the air";
    if (flying == 2) {
        if (!get("outer-loop/on")) return "inner loop alone: outer loop is off";
        if (get("received/sequence") == 0) return "inner loop alone: no outer loop yet";
        if (!get("received/flies")) return "inner loop alone: outer loop has left";
        return sprintf("inner loop alone: no command for %.1f s", get("received/age-s"));
    }
    return get("pilot/has") ? "outer loop; references: pilot" : "outer loop; references: scenario";
}

# What the isolation suspects; of a loop without one, what its detector declares.
var hypotheses = [];
var suspected = func {
    var number = int(get("received/suspect"));
    if (number > 0 and number < size(hypotheses))
        return sprintf("%s, probability %.2f", hypotheses[number], get("received/suspect-probability"));
    return get("received/fault-declared") ? "loss of thrust" : "nothing";
}

var shown = func(name, text) { setprop("/ftc/shown/" ~ name, text); }

var show = func {
    shown("who", who());
    shown("estimate", sprintf("%.3f +- %.3f (2 sigma)", get("received/effectiveness-thrust-est"),
        2 * get("received/effectiveness-thrust-std")));
    shown("suspected", suspected());
    var thrust = 0;
    foreach (var engine; props.globals.getNode("/fdm/jsbsim/propulsion").getChildren("engine"))
        thrust += engine.getValue("thrust-lbs") or 0;
    shown("thrust", sprintf("%6.1f kN commanded   %6.1f kN achieved", get("command/thrust-n") / 1000,
        thrust * 0.0044482));
    shown("load-factor", sprintf("%6.2f commanded   %6.2f achieved", get("command/load-factor"),
        get("load-factor/actual")));
    shown("bank", sprintf("%6.1f deg commanded   %6.1f deg achieved", get("command/bank-rad") * DEGREES,
        get("bank/actual") * DEGREES));
    shown("airspeed", sprintf("%6.1f m/s reference   %6.1f m/s flown", get("received/airspeed-ref"),
        (getprop("/fdm/jsbsim/velocities/vt-fps") or 0) * 0.3048));
    shown("path", sprintf("%6.2f deg reference   %6.2f deg flown",
        get("received/flight-path-angle-ref") * DEGREES, math.asin(get("path/sin")) * DEGREES));
    shown("pilot", sprintf("%.1f m/s, path %.1f deg, bank %.0f deg", get("pilot/airspeed-mps"),
        get("pilot/path-rad") * DEGREES, get("pilot/bank-rad") * DEGREES));
    shown("link", sprintf("%d lines accepted, %d refused, delay %.0f ms", get("received/sequence"),
        get("received/refused"), 1000 * get("received/delay")));
}

var was = "";
var tell = func {
    var now = get("flying") ~ "/" ~ get("pilot/has");
    if (now != was and was != "") screen.log.write(who(), 1, 1, 0.5);
    was = now;
}

var tick = func {
    var has = get("pilot/wanted");
    if (!has or !had) foreach (var axis; keys(stick)) zero[axis] = stick[axis]();
    had = has;
    foreach (var axis; keys(stick)) {
        var moved = stick[axis]() - zero[axis];
        set("pilot/" ~ axis, math.abs(moved) < DEAD ? 0 : math.clamp(moved, -1, 1));
    }
    show();
    tell();
}

setprop("/ftc/dialog/kind", "thrust lost");
setprop("/ftc/dialog/left", 0.6);
setprop("/ftc/dialog/inject", 0);
setprop("/ftc/dialog/repair", 0);
setprop("/ftc/dialog/show", 0);
foreach (var name; ["who", "estimate", "suspected", "thrust", "load-factor", "bank", "airspeed", "path", "pilot", "link"])
    shown(name, "");
setlistener("/ftc/dialog/inject", func(n) { if (n.getValue()) { inject(); n.setValue(0); } }, 0, 0);
setlistener("/ftc/dialog/repair", func(n) { if (n.getValue()) { repair(); n.setValue(0); } }, 0, 0);
setlistener("/ftc/dialog/show", func(n) { if (n.getValue()) { gui.showDialog("ftc-outer-loop"); n.setValue(0); } }, 0, 0);

var timer = maketimer(PERIOD, tick);
setlistener("/sim/signals/fdm-initialized", func { timer.start(); });
