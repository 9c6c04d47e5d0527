"""One machine written in many units: a study with everything, from one set of SI numbers, and a table of units of its own, so that
nothing here is taken from the program. Its steps are fixed: adaptive ones would follow the rounding of the numbers."""
import json

# sizes in SI, of angles in degrees, written down once more
LENGTHS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}
FORCES = {"N": 1.0, "kN": 1e3, "lbf": 0.45359237 * 9.80665}
MASSES = {"kg": 1.0, "t": 1e3, "lb": 0.45359237}
ANGLES = {"deg": 1.0, "rad": 180 / 3.141592653589793, "mrad": 0.18 / 3.141592653589793, "arcsec": 1 / 3600}
TIMES = {"s": 1.0, "ms": 1e-3}


class Units:
    """Numbers in SI (angles in degrees) as those of a study in these units, and back."""

    def __init__(self, length="m", force="N", mass="kg", angle="deg", time="s", natural=None):
        self.words = {"length": length, "force": force, "mass": mass, "angle": angle, "time": time}
        self.natural = natural
        self.L, self.F, self.M = LENGTHS[length], FORCES[force], MASSES[mass]
        self.A, self.T = ANGLES[angle], TIMES[time]
        self.E = self.P = 1.0
        if natural:  # R_b, M, g
            self.L, self.M, self.T = natural[0], natural[1], (natural[0] / natural[2]) ** 0.5
            self.F = self.M * self.L / self.T**2
            self.E, self.P = self.F * self.L, self.F * self.L / self.T

    def size(self, kind):
        L, F, M, A, T = self.L, self.F, self.M, self.A, self.T
        return {"1": 1, "length": L, "force": F, "mass": M, "angle": A, "time": T, "rate": 1 / T, "speed": L / T,
                "angular_speed": A / T, "acceleration": L / T**2, "angular_acceleration": A / T**2, "moment": F * L,
                "stiffness": F / L, "damping": F * T / L, "inertia": M * L**2, "energy": self.E, "power": self.P, "volume": L**3}[kind]

    def put(self, kind, value):
        if isinstance(value, (list, tuple)):
            return [self.put(kind, v) for v in value]
        return value / self.size(kind)

    def label(self, kind):
        """As in tables."""
        if self.natural:
            return "degree" if "ang" in kind else "1"
        w = dict(self.words)
        w["angle"] = "degree" if w["angle"] == "deg" else w["angle"]
        return {"1": "1", "rate": "1/{time}", "speed": "{length}/{time}", "angular_speed": "{angle}/{time}",
                "acceleration": "{length}/{time}2", "angular_acceleration": "{angle}/{time}2", "moment": "{force} {length}",
                "stiffness": "{force}/{length}", "damping": "{force} {time}/{length}", "inertia": "{mass} {length}2",
                "energy": "J", "power": "W"}.get(kind, "{%s}" % kind).format(**w)

    def word(self, kind):
        """As after a number in a text."""
        if self.natural:
            return " deg" if "ang" in kind else ""
        label = self.label(kind).replace("degree", "deg")
        return " " + (label[:-1] + "^2" if label.endswith("2") else label)


BASE = [[1.55, 0.3, 0.01], [-0.55, 1.45, 0], [-1.05, 1.15, -0.02], [-1.0, -1.2, 0], [-0.55, -1.45, 0.03], [1.5, -0.3, 0]]
TOP = [[0.55, 0.75, 0], [0.4, 0.85, 0.01], [-0.9, 0.1, 0], [-0.9, -0.12, -0.02], [0.4, -0.8, 0], [0.5, -0.75, 0.01]]
RADIUS, MASS, GRAVITY = 1.5, 1050.0, 9.80665


def study(u, **changes):
    """YAML (as JSON, which it contains) of the machine in these units. Formulas keep their numbers and are put into units as text."""
    p = u.put

    def f(kind, text):
        return "(%s)*%.17g" % (text.replace("t", "(%.17g*t)" % u.T), 1 / u.size(kind))

    tree = {
        "title": "The same machine",
        "units": "dimensionless" if u.natural else u.words,
        "platform": {
            "base": {"radius": p("length", RADIUS), "half_angle": p("angle", 8.0)},
            "top": {"joints": p("length", TOP)},
            "height": p("length", 2.0),
            "legs": {"length": p("length", [1.2, 3.1]), "max_speed": p("speed", 2.5), "max_force": p("force", 9000.0),
                     "cylinder": {"mass": p("mass", [60, 61, 62, 63, 64, 65]), "center": p("length", 0.55), "inertia": p("inertia", 7.0)},
                     "piston": {"mass": p("mass", 30.0), "center": p("length", 0.7), "inertia": p("inertia", 5.0)},
                     "reflected_mass": p("mass", 140.0),
                     "friction": {"viscous": p("damping", 150.0), "coulomb": p("force", 120.0), "breakaway": p("force", 180.0),
                                  "stribeck_speed": p("speed", 0.02), "smoothing_speed": p("speed", 0.01), "efficiency": 0.95}}},
        "load": {"mass": p("mass", MASS), "center_of_mass": p("length", [0.03, -0.02, 0.25]),
                 "inertia": p("inertia", [[410, 4, -6], [4, 520, 3], [-6, 3, 460]])},
        "motion": {"about": p("length", [0.02, 0.01, 0.3]), "surge": f("length", "0.05*sin(1.1*t)"), "heave": f("length", "0.1*sin(t)"),
                   "roll": f("angle", "3*sin(1.1*t)"), "yaw": f("angle", "5*sin(0.9*t)")},
        "disturbance": {"leg_force": f("force", "20*sin(5*t)"), "vertical_force": f("force", "30*cos(4*t)"),
                        "force": [f("force", "15*sin(3*t)"), 0, 0], "moment": [0, f("moment", "8*cos(2*t)"), 0],
                        "noise": {"leg_force": p("force", 4.0), "force": p("force", 5.0), "moment": p("moment", 3.0),
                                  "interval": p("time", 0.2), "seed": 7}},
        "control": {"stiffness": p("stiffness", [4e5, 4.1e5, 4.2e5, 4e5, 4.1e5, 4.2e5]), "damping": p("damping", 1.5e4)},
        "initial": {"heave": p("length", 0.02), "yaw": p("angle", -1.0), "velocity": p("speed", [0.01, 0, -0.02]),
                    "angular_velocity": p("angular_speed", [0, 3.0, 1.0])},
        "simulation": {"duration": p("time", 1.0), "output_step": p("time", 0.0625), "method": "rk4",
                       "step": p("time", 0.0625 / 64)},
        "sweep": {"keys": {"load.mass": p("mass", [900.0, 1100.0]), "initial.heave": p("length", [0.0, 0.01]),
                           "control.damping": p("damping", [1e4, 2e4])}},
    }
    for path, value in changes.items():
        at = tree
        *way, last = path.split("__")
        for name in way:
            at = at.setdefault(name, {})
        if value is None:
            at.pop(last, None)
        else:
            at[last] = value
    return json.dumps(tree, ensure_ascii=False, indent=1)


ALL = {
    "si": Units(),
    "mm": Units("mm"),
    "um": Units("um", angle="arcsec"),
    "inch": Units("in", "lbf", "lb", "mrad"),
    "ms": Units("ft", "kN", "t", "rad", "ms"),
    "natural": Units(natural=(RADIUS, MASS, GRAVITY)),
}
