"""What each verb prints, line by line and key by key, beside what facts.py and mechanics.py say it should."""
import math
import re

import facts as f
import limits
import mechanics as m
import studies
import sweeps
from facts import Q, Skip
from printed import Line, Table

COMPONENTS = studies.COMPONENTS
PEAKS = 1e-6  # what peaks and integrals of the motion may be off, of the largest


DRIFT = Skip("round-off of the constraints: only that it is small is checked")
EFFORT = Skip("steps and evaluations of the stepper, which the independent computation does not have")
SENTENCE = Skip("a sentence; its numbers are read where it is printed")


def components(names, values, dimension, slack):
    return {name: Q(value, dimension, slack) for name, value in zip(names, values)}


def units_sentence(meaning, units):
    if units.name == "si":
        return "SI units, angles in degrees"
    if meaning.dimensionless and max(abs(size - 1) for size in (units.L, units.M, units.T)) < 1e-14:
        return "dimensionless, angles in degrees"
    return "dimensionless: lengths in R_b, masses in M, times in sqrt(R_b/g); angles in degrees"


# ---- check ----------------------------------------------------------------------------------------------------------

class Check:
    def __init__(self, meaning):
        self.meaning, self.machine = meaning, meaning.machine
        self.scales = f.Scales(meaning)
        self.singular, vectors = self.machine.home.singular_values()
        self.vectors = [[row[k] for row in vectors] for k in range(6)]
        self.determinant = m.solve6(self.machine.home.jacobian(), [0.0] * 6)[1]
        self.moments = sorted(m.eigen(self.machine.inertia)[0])  # in the order of the axes that are printed, see order_of()
        self.ranges = self.program_ranges()

    def order_of(self, printed):
        """Puts the moments in the order of those printed: which axis comes first is free."""
        rank = sorted(range(3), key=lambda k: printed[k])
        self.moments = [self.moments[rank.index(k)] for k in range(3)]

    def program_ranges(self):
        """Least and greatest of each component, angles in radians."""
        meaning, ranges = self.meaning, []
        ends = [0.0] + [t for t in sorted(meaning.corners) if 0 < t < meaning.duration] + [meaning.duration]
        times = [low + (high - low) * k / 60 for low, high in zip(ends, ends[1:]) for k in range(60)] + [meaning.duration]
        jets = [meaning.program(t) for t in times]
        for c in range(6):
            values, bounds = [j[c][0] for j in jets], []
            for sign in (1, -1):
                k = min(range(len(times)), key=lambda i: sign * values[i])
                first = min(max(k - 1, 0), len(times) - 3)
                near = [sign * v for v in values[first:first + 3]]
                bounds.append(sign * f.refined(times[first:first + 3], near, lambda t: sign * meaning.program(t)[c][0])[0])
            ranges.append(tuple(bounds))
        return ranges

    def weakest_allowed(self):
        """Names that the motion of the least singular value may have: of a pair of equal values any mixture may be meant."""
        least = min(self.singular)
        space = [v for v, s in zip(self.vectors, self.singular) if s < least * (1 + 1e-7)]
        allowed = set()
        for k in range(6):
            # the vector of the space with the largest component k is the projection of the unit vector
            image = [sum(v[k] * v[i] for v in space) for i in range(6)]
            if image[k] > 0 and abs(image[k]) >= max(abs(x) for x in image) * (1 - 1e-7):
                allowed.add(COMPONENTS[k])
        return allowed

    def groups(self):
        meaning, machine = self.meaning, self.machine
        L, M, T = machine.units()
        return {"h": machine.height / L, "r": machine.top_radius / L, "J": [x / (M * L * L) for x in self.moments],
                "G": [g * T * T / M for g in meaning.stiffness], "D": [d * T / M for d in meaning.damping]}

    def limits_json(self):
        """Limits of the legs; the studies of the campaign have none of the platform."""
        given, none = self.meaning.limits, [[None, None]] * 6
        bound = lambda x, d: Q(x, d, 1e-11 * abs(x))
        low, high = given.get("length", (0.0, None))
        speed, force = (given.get(key) for key in ("max_speed", "max_force"))
        return {"legs": {"length": [[bound(low, "length"), bound(high, "length") if high else None]] * 6,
                         "speed": [bound(speed, "speed") if speed else None] * 6,
                         "force": [[bound(-force, "force"), bound(force, "force")]] * 6 if force else none,
                         "acceleration": [None] * 6, "base_swing": [None] * 6, "top_swing": [None] * 6},
                "platform": {"pose": none, "speed": none, "acceleration": none,
                             "about": Skip("the point of the motion")}}

    def json(self):
        meaning, machine, tree = self.meaning, self.machine, self.meaning.tree
        s, eps = self.scales.size, 1e-11
        groups, T = self.groups(), machine.units()[2]
        length = meaning.limits.get("length", (0.0, None))
        bound = lambda x, d: Q(x, d, eps * abs(x))
        each = lambda values, d, scale: [Q(x, d, eps * scale) for x in values]
        gains = lambda values: [None if math.isnan(x) else Q(x, None, eps * max(values)) for x in values]
        program = {"kind": "moves" if meaning.moves is not None else "formulas", "order": "zyx"}
        if meaning.moves is not None:
            program["moves"] = Skip("compared as the motion that they make")
        for c, name in enumerate(COMPONENTS):
            program[name] = each(self.ranges[c], "length" if c < 3 else "angle", s["length"] if c < 3 else 1.0)
        fixed = meaning.step is not None
        top = max(self.moments)
        out = {
            "verb": "check", "title": tree.get("title", ""), "units": "dimensionless" if meaning.dimensionless else "si",
            "home_length": each(machine.home.length, "length", s["length"]),
            "stroke": [bound(length[0], "length"), bound(length[1], "length") if length[1] else None],
            "limits": self.limits_json(),
            "condition": Q(machine.home.condition(), None, 1e-9 * machine.home.condition()),
            "determinant": Q(self.determinant, "volume", 1e-9 * abs(self.determinant)),
            "least_singular_value": Q(min(self.singular), None, 1e-9),
            "weakest_motion": self.weakest_allowed(),
            "principal_moments": [Q(x, "inertia", eps * top) for x in self.moments],
            "principal_axes": Skip("compared as axes of the tensor of inertia"),
            "leg_mass": Q(0, "mass", 0), "leg_mass_on_top": Q(0, "mass", 0), "external": [],
            "pose": Skip("held by tests/linear/test_stiffness.c"),
            "base_radius": bound(machine.base_radius, "length"),
            "time_unit": None if math.isnan(T) else bound(T, "time"),
            "groups": {"height": Q(groups["h"], None, eps), "top_radius": Q(groups["r"], None, eps),
                       "inertia": each(groups["J"], None, max(groups["J"])),
                       "stiffness": gains(groups["G"]), "damping": gains(groups["D"])},
            "program": program, "control": self.control_json(), "actuators": self.actuators_json(), "sampling": None,
            "simulation": {"duration": bound(meaning.duration, "time"), "output_step": bound(meaning.output_step, "time"),
                           "method": meaning.method, "step": bound(meaning.step, "time") if fixed else None,
                           "tolerance": None if fixed else bound(meaning.tolerance, None)}}
        if "sweep" in tree:
            out["sweep"] = sweeps.described(tree["sweep"])
        return out

    def facts(self):
        """Names of numbers in the text to Q."""
        meaning, machine, tree, j = self.meaning, self.machine, self.meaning.tree, self.json()
        s, out = self.scales.size, {}
        for k in range(6):
            out[f"home[{k + 1}]"] = j["home_length"][k]
            for c, axis in enumerate("xyz"):
                out[f"base_{axis}[{k + 1}]"] = Q(machine.base[k][c], "length", 1e-12 * s["length"])
                out[f"top_{axis}[{k + 1}]"] = Q(machine.top[k][c], "length", 1e-12 * s["length"])
        limits = meaning.limits
        low, high = limits.get("length", (0, 0))
        out |= {"limit_low": Q(low, "length", 0), "limit_high": Q(high, "length", 0),
                "max_speed": Q(limits.get("max_speed", 0), "speed", 0), "max_force": Q(limits.get("max_force", 0), "force", 0),
                "condition": j["condition"], "determinant": Q(abs(self.determinant), "volume", j["determinant"].slack),
                "least_singular": j["least_singular_value"], "arm": Q(machine.arm, "length", 1e-12 * s["length"]),
                "mass": Q(machine.mass, "mass", 0), "R_b": j["base_radius"], "h": j["groups"]["height"],
                "r": j["groups"]["top_radius"], "time_unit": j["time_unit"], "duration": j["simulation"]["duration"],
                "output_step": j["simulation"]["output_step"], "step": j["simulation"]["step"],
                "tolerance": j["simulation"]["tolerance"]}
        out |= components(("cx", "cy", "cz"), machine.centre, "length", 0)
        out |= components(("gx", "gy", "gz"), machine.gravity, "acceleration", 0)
        out |= components(("about_x", "about_y", "about_z"), machine.about, "length", 0)
        out |= {f"moment_{k}": q for k, q in enumerate(j["principal_moments"])}
        out |= {f"group_J{k}": q for k, q in enumerate(j["groups"]["inertia"])}
        for name, values, dimension in (("G", meaning.stiffness, "stiffness"), ("D", meaning.damping, "damping")):
            out[name + "_low"], out[name + "_high"] = Q(min(values), dimension, 0), Q(max(values), dimension, 0)
            group = [q.value for q in j["groups"]["stiffness" if name == "G" else "damping"] if q]
            if group:
                out[f"group_{name}_low"] = Q(min(group), None, 1e-11 * max(group))
                out[f"group_{name}_high"] = Q(max(group), None, 1e-11 * max(group))
        for c, name in enumerate(COMPONENTS):
            out[name + "_low"], out[name + "_high"] = j["program"][name]
        baumgarte = meaning.constraints.get("baumgarte") if isinstance(meaning.constraints, dict) else (0, 0)
        out |= {"alpha": Q(baumgarte[0], None, 0), "beta": Q(baumgarte[1], None, 0)}
        return out | (sweeps.facts_described(tree["sweep"]) if "sweep" in tree else {})

    def lines(self, name, units):
        meaning, machine, tree = self.meaning, self.machine, self.meaning.tree
        limits, u = meaning.limits, units.name
        table = [("", "length at home", "length", "home")] + [("base joint []", a, "length", "base_" + a) for a in "xyz"]
        table += [("top joint, top frame []", a, "length", "top_" + a) for a in "xyz"]
        known = [f"{name} is a valid study; {units_sentence(meaning, units)}", "Legs", "At home"]
        if "title" in tree:
            known.append(tree["title"])
        if "length" in limits:
            known.append("length limits {limit_low} to {limit_high length}")
        if "max_speed" in limits:
            known.append("greatest speed {max_speed speed}")
        if "max_force" in limits:
            known.append("greatest force {max_force force}")
        if not limits:
            known.append("limits none given")
        known += ["condition {condition} (singular from 1e8)", "|det J| {determinant volume}",
                  "least singular value {least_singular} of J (moments divided by {arm length}; 0 is singular);",
                  "the weakest direction is {weakest word}", "Load (the model has massless legs)",
                  "mass {mass mass}, centre of mass {cx}, {cy}, {cz length}",
                  "principal moments {moment_0}, {moment_1}, {moment_2 inertia}",
                  *(f"axis of the {name} (" + ", ".join(f"{{axis_{a}{k} .4}}" for k in range(3)) + ")"
                    for a, name in enumerate(("first", "second", "third"))),
                  "gravity {gx}, {gy}, {gz acceleration}", "Dimensionless groups", "R_b {R_b length}", "h/R_b {h}", "r/R_b {r}",
                  "J/(M R_b^2) {group_J0}, {group_J1}, {group_J2}"]
        if m.norm(machine.gravity) > 0:
            span = lambda name, values: f"{{{name}_low}} to {{{name}_high}}" if max(values) > min(values) else f"{{{name}_low}}"
            known += ["G R_b/(M g) " + span("group_G", meaning.stiffness), "D sqrt(R_b/g)/M " + span("group_D", meaning.damping),
                      "sqrt(R_b/g) {time_unit time}, the unit of time"]
        else:
            known.append("without gravity there is no unit of time and there are no groups of G and D")
        known += self.program_lines() + self.control_lines() + self.setting_lines()
        if "sweep" in tree:
            known += sweeps.lines_described(tree["sweep"])
        return [Line(text, u) for text in known] + [Table(table, u, False)]

    def control_json(self):
        meaning, each = self.meaning, lambda values, d: [Q(x, d, 1e-12 * abs(x)) for x in values]
        return {"law": "leg", "feedforward": meaning.feedforward, "stiffness": each(meaning.stiffness, "stiffness"),
                "damping": each(meaning.damping, "damping"), "integral": [Q(0, None, 0)] * 6, "tracking_time": None, "sampled": False,
                "model": {"legs": True, "friction": True, "external": True}}

    def actuators_json(self):
        none = [None] * 6
        return {"kind": "ideal", "max_force": none, "time_constant": none, "frequency": none, "damping_ratio": none,
                "max_rate": none}

    def program_lines(self):
        moves, about = self.meaning.moves, self.machine.about
        known = ["Program"]
        if moves is None:
            known.append("formulas in t")
        else:
            known.append(f"{len(moves)} minimum-jerk move{'' if len(moves) == 1 else 's'}")
        moving = [c for c in range(6) if any(self.ranges[c])]
        known += [f"{COMPONENTS[c]} {{{COMPONENTS[c]}_low}} to {{{COMPONENTS[c]}_high {'length' if c < 3 else 'angle'}}}" for c in moving]
        if not moving:
            known.append("rest at home")
        if any(about):
            known.append("of the point {about_x}, {about_y}, {about_z length} in the top frame")
        return known

    def control_lines(self):
        meaning = self.meaning

        def span(name, values, dimension):
            low, high = f"{{{name}_low}}", f"{{{name}_low {dimension}}}"
            return f"{low} to {{{name}_high {dimension}}}" if max(values) > min(values) else high

        feedforward = "the program's forces" if meaning.feedforward else "none"
        loop = "" if max(meaning.stiffness) > 0 else ": open loop"
        return ["Control", f"feedforward {feedforward}", f"stiffness G {span('G', meaning.stiffness, 'stiffness')}{loop}",
                f"damping D {span('D', meaning.damping, 'damping')}"]

    def setting_lines(self):
        meaning = self.meaning
        known = ["Simulation", "duration {duration time}, a row every {output_step time}"]
        known.append(f"method {meaning.method}, " + ("step {step time}" if meaning.step else "tolerance {tolerance .3}"))
        if meaning.method.startswith("rattle"):
            known.append("constraints kept by the method")
        elif isinstance(meaning.constraints, dict):
            known.append("constraints Baumgarte, alpha {alpha}, beta {beta}")
        else:
            known.append(f"constraints {meaning.constraints}")
        return known


# ---- forces and simulate --------------------------------------------------------------------------------------------

def deviation_line(said):
    """The line of deviations: each is a number, or the bound below which it is only an error of the run."""
    parts = {name: f"below {{{name}_below .1 {dimension}}}" if re.search(pattern, said) else f"{{{name} .4 {dimension}}}"
             for name, dimension, pattern in (("position", "length", r"deviation +below"), ("angle", "angle", r"deviation .* and below"))}
    first = "" if "below" in parts["position"] else "at most "
    second = "at most " if "below" in parts["position"] and "below" not in parts["angle"] else ""
    return f"deviation {first}{parts['position']} and {second}{parts['angle']} from the program"


def noise_of(meaning, units):
    """Below what deviations are only errors of a run, in position and angle."""
    adaptive = meaning.method == "dop853" and not meaning.step
    share = min(max(100 * meaning.tolerance if adaptive else 0, 1e-12), 1e-6)
    length = units.of(Q(max(meaning.machine.home.length), "length", 0))[0]
    return {"position": share * length, "angle": share * 180 / math.pi}


def summary_lines(meaning, units, simulated, title, said=""):
    u = units.name
    length, force, power = "length []", "force []", "power []"
    strokes = [(length, "least", "length", "length_least"), (length, "greatest", "length", "length_greatest"),
               (length, "used", "length", "used")]
    limited = meaning.limits.get("length", (0,))[0] > 0
    if limited:
        strokes.append(("stroke", "used %", None, "share"))
    strokes += [("", "peak speed|", "speed", "speed"), ("swing [deg] at", "base", "angle", "base"), ("swing [deg] at", "top", "angle", "top")]
    loads = [(force, "least", "force", "force_least"), (force, "greatest", "force", "force_greatest"), (force, "peak", "force", "force_peak"),
             (force, "RMS", "force", "rms"), (power, "least", "power", "power_least"), (power, "greatest", "power", "power_greatest"),
             ("energy []", "net", "energy", "energy"), ("energy []", "returned", "energy", "returned")]
    known = [Table(strokes, u, True), Table(loads, u, True)]
    text = [title] if title else []
    text += [units_sentence(meaning, units),
             ("Motion under control and disturbance" if simulated else "Forces along the program") + ": {rows} rows, t = {first} to {last time}",
             "condition at most {condition .4}, at t = {condition_time time} (1 is best, 1e8 counts as singular)",
             "legs massless in this model: add the forces of their own "
             + ("weight and inertia" if m.norm(meaning.machine.gravity) > 0 else "inertia")]
    if limited:
        text.append("stroke {stroke length} available, from {stroke_low} to {stroke_high length}")
    if simulated:
        text += [deviation_line(said),
                 "drift at most {drift .2} (violation of the constraints before projection)"]
    effort = [Line("steps {steps}" + rejected + "; {evaluations} evaluations of the equations of motion", u, True)
              for rejected in ("", ", and {rejected} rejected") if simulated]
    return known + [Line(x, u) for x in text] + effort


def rows_lines(units):
    """What is said where rows are too far apart; whether it must be is for compare_rows()."""
    return [Line("rows too far apart to draw the motion: between two rows leg {leg} moves up to", units.name, True),
            Line("{between .4 length} beyond both; to draw it, set simulation.output_step to {drawing .3 time} or less", units.name, True)]


class Run:
    """Numbers that forces and simulate have in common. Needs: curves (Instant or Curves), rows (times), legs, end_*."""

    verb, simulated = "", False
    worst_time_slack = 0.0

    def __init__(self, meaning):
        self.meaning, self.scales, self.nearest = meaning, f.Scales(meaning), {}

    def finish(self, curves, span, slack):
        self.curves, self.until = curves, span
        self.legs = f.leg_facts(curves, span, self.scales, slack)
        self.condition, self.condition_time = curves.extremes(("condition", 0))[1]
        self.condition_slack = 20 * slack * self.condition + 1e-15 * self.condition ** 3
        low, high = self.meaning.limits.get("length", (0, 0))
        self.stroke = high - low if low > 0 else None

    def compare_rows(self, case, records, units):
        """Whether rows too far apart are said to be, and how far a leg goes beyond two of them."""
        said = next((r for r in records if "between" in r), None)
        if not isinstance(self.curves, f.Curves):
            return
        most = self.curves.beyond_rows(self.meaning.output_step, self.row_count) if self.row_count > 1 else 0.0
        stroke = max(leg["used"].value for leg in self.legs)
        if said or most > 0.052 * stroke > 1e-9 * self.scales.length:
            case.same(f"{self.verb} text rows too far apart", bool(said), most > 0.048 * stroke)
        if said:
            case.near(f"{self.verb} text between rows", said["between"].value, *units.of(Q(most, "length", 0.01 * most)), said["between"].half)

    def share(self, used):
        return Q(100 * used.value / self.stroke, None, 100 * used.slack / self.stroke)

    def facts(self):
        out = limits.sentence_facts(self.end) | {"end_time": Q(self.end["time"], "time", self.end["slack"]), "last_time": Q(self.last, "time", 1e-12 * self.last),
               "rows": Q(self.row_count, None, 0), "first": Q(0, "time", 0), "last": Q(self.last, "time", 1e-12 * self.last),
               "condition": Q(self.condition, None, self.condition_slack)}
        for row, leg in [(str(k + 1), leg) for k, leg in enumerate(self.legs)] + [("all", f.over_all(self.legs))]:
            out |= {f"{name}[{row}]": q for name, q in leg.items()}
            if self.stroke:
                out[f"share[{row}]"] = self.share(leg["used"])
        if self.stroke:
            low, high = self.meaning.limits["length"]
            out |= {"stroke": Q(self.stroke, "length", 1e-12 * high), "stroke_low": Q(low, "length", 0), "stroke_high": Q(high, "length", 0)}
        return out

    def holding(self):
        """Drive forces that hold the legs at rest at home; without friction those that carry the weight."""
        home = self.meaning.machine.home
        forces = home.balance(*home.required())
        return [Q(x, "force", 1e-12 * self.scales.size["force"] * home.condition()) for x in forces]

    def leg_json(self, leg, hold):
        pair = lambda name: [leg[name + "_least"], leg[name + "_greatest"]]
        share = self.share(leg["used"]) if self.stroke else None
        return {"length": pair("length"), "speed": leg["speed"], "force": pair("force"), "rms_force": leg["rms"],
                "power": pair("power"), "energy": leg["energy"], "swing": {"base": leg["base"], "top": leg["top"]},
                "stroke_used": Q(share.value / 100, None, share.slack / 100) if share else None,
                "joint_load": {"top": leg["force_peak"], "base": leg["force_peak"]}, "side_load": Q(0, "force", 0),
                "friction_loss": Q(0, "energy", 0), "returned_energy": leg["returned"],
                "braking_power": Q(max(0.0, -leg["power_least"].value), "power", leg["power_least"].slack),
                "saturated": Q(0, None, 0) if self.verb == "simulate" else None, "saturated_at": None, "sample_error": None, "sample_error_at": None, "holding": [hold, hold]}

    def json(self):
        return {"verb": self.verb, "title": self.meaning.tree.get("title", ""),
                "end": {"status": self.end["status"], "time": Q(self.end["time"], "time", self.end["slack"]),
                        "leg": self.end["leg"], "message": SENTENCE, "legs": self.end["legs"],
                        "limit": limits.sentence_facts(self.end).get("end_limit"), "component": None, "least": False},
                "legs": [self.leg_json(leg, hold) for leg, hold in zip(self.legs, self.holding())],
                "condition": Q(self.condition, None, self.condition_slack),
                "deviation": {"position": None, "angle": None}, "drift": None, "external_work": None, "statistics": None, "limits": limits.json(self)}

    def limit_lines(self, units):
        return limits.lines(self, units)


class Forces(Run):
    verb, slack = "forces", 2e-10

    def __init__(self, meaning, axes):
        super().__init__(meaning)
        self.axes, self.row_count = axes, meaning.rows
        self.plant = meaning.plant
        self.worst_time_slack = meaning.output_step / 4  # the time is that of a look: near the peak, not at it
        self.last = meaning.time(meaning.rows - 1)
        self.motion = f.Curves(self.pieces())
        self.finish(self.motion, meaning.duration, PEAKS)
        self.find_crossings()

    def pieces(self):
        """Samples between the corners of the program."""
        until = self.meaning.duration
        ends = [0.0] + [t for t in self.meaning.stops if t < until] + [until]
        for low, high in zip(ends, ends[1:]):
            count = max(2, math.ceil(40 * (high - low) / until))
            yield [low + (high - low) * k / count for k in range(count + 1)], self.sample

    def sample(self, t):
        pose = self.plant.program_pose(t)
        return f.quantities(self.meaning, pose, self.plant.program_forces(pose))

    def condition_at(self, t):
        return self.plant.program_pose(t).condition()

    def left_out(self):
        """Forces along a program know no disturbance: which ones they leave out."""
        names = [name for name in ("leg_force", "vertical_force", "force", "moment", "noise") if name in self.meaning.tree.get("disturbance", {})]
        if not names:
            return []
        return ["left out disturbance: " + ", ".join(names), "(these are the program's forces alone; gough simulate includes disturbances)"]

    def end_lines(self, units):
        left_out = [Line(x, units.name) for x in self.left_out()]
        if not self.crossings:
            return left_out + [Line("end the whole duration, t = {end_time time}", units.name)]
        return left_out + [Line("end t = {last_time time}; limits are exceeded, first at t = {end_time time}", units.name)]

    def rows(self):
        for k in range(self.meaning.rows):
            t = self.meaning.time(k)
            pose = self.plant.program_pose(t)
            yield f.row_of(self.meaning, t, pose, self.plant.program_forces(pose), axes=self.axes)

    def find_crossings(self):
        """All intervals beyond a limit, and the end that follows: the first of them."""
        self.crossings = []
        for kind, limit in limits.given(self.meaning).items():
            for leg in range(6):
                name = limits.KINDS[kind][1], leg
                for enter, leave in self.motion.intervals(name, lambda v: limits.share(kind, limit, v) - 1):
                    until = self.meaning.duration if leave is None else leave
                    worst, time = self.motion.worst(name, enter, until, lambda v: limits.share(kind, limit, v))
                    self.crossings.append({"kind": kind, "leg": leg + 1, "enter": enter, "leave": leave, "worst": worst, "worst_time": time})
        self.crossings.sort(key=lambda c: (c["enter"], c["leg"]))
        slack = 1e-7 * self.meaning.duration
        self.end = {"status": "done", "time": self.meaning.duration, "leg": None, "legs": [], "slack": 1e-12 * self.meaning.duration}
        if self.crossings:
            first = min(self.crossings, key=lambda c: (c["enter"], list(limits.KINDS).index(c["kind"])))
            pose = self.plant.program_pose(first["enter"])
            beyond = limits.margins(self.meaning, pose.length, pose.rate, self.plant.program_forces(pose))
            self.end = limits.ending(first["kind"], limits.given(self.meaning)[first["kind"]], first["enter"], slack, beyond)


NEAR_A_LIMIT = 0.05  # a share of the limit: no further does a run go between two moments that are kept


class Singular(Exception):
    """The motion passes a singular pose."""


class Simulate(Run):
    verb, simulated = "simulate", True

    def __init__(self, meaning, axes=None, tolerance=1e-11):
        super().__init__(meaning)
        self.axes, self.table, self.side = axes, [], None
        plant = meaning.plant
        plant.set_scale(self.scales.length, self.scales.time)
        state, t = meaning.start(), 0.0
        self.end = {"status": "done", "time": meaning.duration, "leg": None, "legs": [], "slack": 1e-12 * meaning.duration}
        self.crossings, self.pieces, self.start_state = [], [([], [])], (t, state)
        # a fixed step over a corner of the program costs it its order
        self.slack = 2e-4 if meaning.step and meaning.stops else 3e-8
        self.add_row(t, state)
        self.watch_singular(t, state)
        broken = self.broken(t, state)
        if broken:
            self.end_at(None, t, broken, tolerance)
        for k in range(1, 0 if broken else meaning.rows + 1):
            until = meaning.time(k) if k < meaning.rows else meaning.duration
            if not until > t:
                continue
            before, kept = (t, state), [(times[:], states[:]) for times, states in self.pieces]
            t, state = until, self.sampled(t, until, state, tolerance)
            self.watch_singular(t, state)
            low, high, broken = self.first_broken(before, tolerance)
            if broken:
                self.end_at(low, high, broken, tolerance)
                self.pieces = kept
                self.sampled(before[0], self.end["time"], before[1], tolerance)
                break
            if k < meaning.rows:
                self.add_row(t, state)
        self.row_count = len(self.table)
        self.summarise()

    def summarise(self):
        self.last = self.meaning.time(self.row_count - 1)
        if self.end["time"] > 0:
            curves = f.Curves([self.piece(times, states) for times, states in self.pieces if times[-1] - times[0] > 1e-9 * self.meaning.output_step])
        else:
            curves = f.Instant(self.sample(*self.start_state))
        self.finish(curves, self.pieces[-1][0][-1], max(self.slack, PEAKS))
        self.position, self.angle = curves.extremes("position")[1][0], curves.extremes("angle")[1][0]

    def piece(self, times, states):
        """Times and the quantities at any of them. States much nearer to each other than others spoil a polynomial: some are left out."""
        least, kept = min(0.12 * self.meaning.output_step, 0.2 * (times[-1] - times[0])), [0]
        for i, t in enumerate(times):
            if t - times[kept[-1]] > least and (times[-1] - t > least or i == len(times) - 1):
                kept.append(i)
        if kept[-1] != len(times) - 1:
            kept.append(len(times) - 1)
        times, states = [times[i] for i in kept], [states[i] for i in kept]
        between = f.States(times, states, [self.meaning.plant.derivative(t, state) for t, state in zip(times, states)])
        return times, lambda t: self.sample(t, between.at(t))

    def advance(self, t, until, state, tolerance):
        for stop in [s for s in self.meaning.stops if t < s < until] + [until]:
            state = self.meaning.plant.step(t, stop - t, state, tolerance)
            t = stop
        return state

    def sampled(self, t, until, state, tolerance):
        """The same, and keeps the state at each quarter of the way; a corner ends a piece."""
        for stop in [s for s in self.meaning.stops if t < s < until] + [until]:
            start = t
            for quarter in range(1, 5):
                at = stop if quarter == 4 else start + (stop - start) * quarter / 4
                state = self.meaning.plant.step(t, at - t, state, tolerance)
                t = at
                self.keep(t, state)
            if stop in self.meaning.stops:
                self.pieces.append(([t], [state]))
        return state

    def keep(self, t, state):
        self.pieces[-1][0].append(t)
        self.pieces[-1][1].append(state)

    def sample(self, t, state):
        pose = self.meaning.plant.pose_of(state)
        u = self.meaning.plant.legs(t, pose)[0]
        wanted = self.meaning.plant.of_time(t)[0]
        sample = f.quantities(self.meaning, pose, u)
        sample["position"], sample["angle"] = m.norm(m.sub(pose.p, wanted.p)), m.turn_between(pose.R, wanted.R)
        return sample

    def broken(self, t, state):
        pose = self.meaning.plant.pose_of(state)
        u = self.meaning.plant.legs(t, pose)[0]
        self.beyond = limits.margins(self.meaning, pose.length, pose.rate, u)
        return {key: value for key, value in self.beyond.items() if value > 1e-12}

    def first_broken(self, before, tolerance):
        """The first moment since `before` that is beyond a limit, of those kept and, near a limit, of eight between two of them;
        the moment before it, and the limits."""
        since = [(t, state) for times, states in self.pieces for t, state in zip(times, states) if t > before[0]]
        self.broken(*before)
        near = max(self.beyond.values(), default=-1) > -NEAR_A_LIMIT
        for t, state in since:
            there = self.broken(t, state)
            was_near, near = near, max(self.beyond.values(), default=-1) > -NEAR_A_LIMIT
            for part in range(1, 8 if was_near or near else 1):
                at = before[0] + (t - before[0]) * part / 8
                inside = self.broken(at, self.advance(before[0], at, before[1], tolerance))
                if inside:
                    return before, at, inside
            if there:
                self.broken(t, state)
                return before, t, there
            before = t, state
        return before, before[0], {}

    def watch_singular(self, t, state):
        """A motion that passes a singular pose is no run to compare with."""
        jacobian = self.meaning.plant.pose_of(state).jacobian()
        side = m.solve6([list(row) for row in jacobian], [0.0] * 6)[1] > 0
        if self.side is None:
            self.side = side
        if side != self.side:
            raise Singular(t)

    def end_at(self, before, t, broken, tolerance):
        """When the first limit is passed within the step from `before`."""
        if before is not None:
            low, high, beyond = before[0], t, self.beyond
            for _ in range(44):
                middle = (low + high) / 2
                here = self.broken(middle, self.advance(before[0], middle, before[1], tolerance))
                if here:
                    high, broken, beyond = middle, here, self.beyond
                else:
                    low = middle
                if high - low < 1e-10 * self.meaning.duration:
                    break
            t, self.beyond = high, beyond
        kind = min(broken, key=lambda key: list(limits.KINDS).index(key[0]))[0]
        if before is not None:
            kind = max(broken, key=broken.get)[0]
        self.end = limits.ending(kind, limits.given(self.meaning)[kind], t, 30 * self.slack * self.meaning.duration, self.beyond)

    def add_row(self, t, state):
        plant = self.meaning.plant
        pose, u = plant.full_pose(t, state)
        turn = self.meaning.disturbance_at(t)[3] if self.meaning.disturbed else (0, 0, 0)
        self.table.append(f.row_of(self.meaning, t, pose, u, plant.of_time(t)[0], self.axes, turn))
        if t == 0:
            self.keep(t, state)

    def rows(self):
        return iter(self.table)

    def end_lines(self, units):
        if self.end["status"] == "done":
            return [Line("end the whole duration, t = {end_time time}", units.name)]
        return [Line("end " + limits.sentence(self.end, units), units.name)]

    def condition_at(self, t):
        if self.end["time"] > 0:
            return self.curves.at(("condition", 0), t)
        return self.table[min(len(self.table) - 1, round(t / self.meaning.output_step))]["condition"][0]

    def deviation(self):
        length, turn = max(self.slack * self.scales.length, 1e-6 * self.position), max(self.slack, 1e-6 * self.angle)
        return Q(self.position, "length", length), Q(self.angle, "angle", turn)

    def facts(self):
        position, angle = self.deviation()
        return super().facts() | {"position": position, "angle": angle}

    def json(self):
        position, angle = self.deviation()
        return super().json() | {"deviation": {"position": position, "angle": angle}, "drift": DRIFT, "statistics": EFFORT}
