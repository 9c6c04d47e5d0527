"""The verb sweep: which runs a study asks for, and what their table and summary should say."""
import itertools
import math

import facts as f
import studies
from facts import Q, Skip
from printed import Line

CLOCK = Skip("time on the clock")
CAUSES = {"leg_short": "ended: a leg too short", "leg_long": "ended: a leg too long", "leg_speed": "ended: a leg too fast",
          "leg_force": "ended: a leg's force too great"}


# ---- which runs -----------------------------------------------------------------------------------------------------

def values_of(key):
    """The values of a list or a grid; None for a distribution."""
    if isinstance(key, list):
        return key
    if "from" not in key:
        return None
    low, high, n = key["from"], key["to"], key["steps"]
    if key.get("scale") == "log":
        return [low * (high / low) ** (k / (n - 1)) for k in range(n)]
    return [low + (high - low) * k / (n - 1) for k in range(n)]


def runs_of(keys):
    """Settings of each run, in order: a mapping of paths to values."""
    fixed = [(path, values_of(key)) for path, key in keys["keys"].items() if values_of(key) is not None]
    if keys.get("combine") == "zip":
        chosen = list(zip(*(values for _, values in fixed)))
    else:
        chosen = list(itertools.product(*(values for _, values in fixed)))
    if not fixed:
        chosen = [()] * keys["runs"]
    out = []
    for number, values in enumerate(chosen, 1):
        given, draws, settings = dict(zip((path for path, _ in fixed), values)), itertools.count(), {}
        for path, key in keys["keys"].items():
            if path in given:
                settings[path] = given[path]
            elif "uniform" in key:
                low, high = key["uniform"]
                settings[path] = low + (high - low) * studies.uniform(keys.get("seed", 0), number, next(draws))
            else:
                mean, deviation = key["normal"]
                settings[path] = mean + deviation * studies.normal(keys.get("seed", 0), number, next(draws))
        out.append(settings)
    return out


def kind_of(key):
    if isinstance(key, list):
        return "list"
    if "from" in key:
        return "logarithmic" if key.get("scale") == "log" else "linear"
    return "uniform" if "uniform" in key else "normal"


def range_of(key):
    values = values_of(key)
    if values is None:
        return key.get("uniform") or key["normal"]
    return [min(values), max(values)] if isinstance(key, list) else [key["from"], key["to"]]


def described(keys):
    """What check --json says of a sweep."""
    out = []
    for path, key in keys["keys"].items():
        values = values_of(key)
        out.append({"key": path, "kind": kind_of(key), "values": len(values) if values else None,
                    "range": [Q(x, None, 0) for x in range_of(key)]})
    return {"runs": len(runs_of(keys)), "combine": keys.get("combine", "product"), "keys": out}


def lines_described(keys):
    zipped = ", values side by side" if keys.get("combine") == "zip" else ""
    lines = ["Sweep", "runs {sweep_runs}" + zipped]
    for path, key in keys["keys"].items():
        low, high, kind, values = f"{{{path}_low}}", f"{{{path}_high}}", kind_of(key), values_of(key)
        if kind == "normal":
            lines.append(f"{path} normal, mean {low}, deviation {high}")
        elif kind == "uniform":
            lines.append(f"{path} uniform, {low} to {high}")
        else:
            lines.append(f"{path} {{{path}_count}} value{'' if len(values) == 1 else 's'}, {low} to {high}, {kind}")
    return lines


def facts_described(keys):
    out = {"sweep_runs": Q(len(runs_of(keys)), None, 0)}
    for path, key in keys["keys"].items():
        low, high = range_of(key)
        out |= {path + "_low": Q(low, None, 0), path + "_high": Q(high, None, 0)}
        if values_of(key):
            out[path + "_count"] = Q(len(values_of(key)), None, 0)
    return out


# ---- what comes out -------------------------------------------------------------------------------------------------

class Sweep:
    """simulate(meaning) makes the run of one study, as verbs.Simulate is."""

    def __init__(self, tree, simulate):
        self.tree, self.keys = tree, tree["sweep"]
        self.settings = runs_of(self.keys)
        self.runs = [simulate(studies.Meaning(studies.changed(tree, settings), number))
                     for number, settings in enumerate(self.settings, 1)]
        self.scales = f.Scales(studies.Meaning(tree))
        self.done = [k for k, run in enumerate(self.runs) if run.end["status"] == "done"]

    def numbered_noise(self):
        """Whether --run must name the number of the noise: there is some, and its run is not given."""
        noise = self.tree.get("disturbance", {}).get("noise")
        return bool(noise) and "run" not in noise

    def set_of(self, number):
        """What --run NUMBER names."""
        out = {path: Q(value, None, 4e-15 * abs(value)) for path, value in self.settings[number - 1].items()}
        return out | ({"disturbance.noise.run": number} if self.numbered_noise() else {})

    def row(self, k):
        """Columns of one run: name to Q, or to a word or whole number that must be the same."""
        run, wide = self.runs[k], f.over_all(self.runs[k].legs)
        share, size = 4 * run.slack, run.scales.size
        out = {"run": k + 1}
        for path, value in self.settings[k].items():
            out[path] = Q(value, None, 4e-15 * abs(value))
        for name in "x y z roll pitch yaw vx vy vz wx wy wz".split():
            value, dimension = run.table[-1][name]
            largest = max(abs(row[name][0]) for row in run.table)
            out[name] = Q(value, dimension, share * (largest + size[dimension]))
        out["position_deviation"], out["angle_deviation"] = run.deviation()
        least, greatest = wide["power_least"], wide["power_greatest"]
        out |= {"force": wide["force_peak"], "speed": wide["speed"], "power": Q(max(0.0, greatest.value), "power", greatest.slack),
                "energy": wide["energy"], "drift": Q(0.0, None, 1e-6), "power_least": least, "power_greatest": greatest,
                "end_cause": run.end["status"], "end_leg": run.end["leg"] or 0, "end_time": Q(run.end["time"], "time", run.end["slack"])}
        return out

    def extreme(self, which, name):
        """Least (min) or greatest (max) of a column over the runs that reached their end: its Q and the runs that may be named."""
        values = {k + 1: self.row(k)[name] for k in self.done}
        best = which(values.items(), key=lambda item: item[1].value)[1]
        return best, {k for k, q in values.items() if abs(q.value - best.value) <= q.slack + best.slack}

    EXTREMES = (("position_deviation", "position_deviation", "position_deviation", "length"),
                ("angle_deviation", "angle_deviation", "angle_deviation", "angle"), ("force", "force", "force", "force"),
                ("speed", "speed", "speed", "speed"), ("power", "power_least", "power_greatest", "power"))

    def ended(self):
        out = {}
        for run in self.runs:
            if run.end["status"] != "done":
                out[run.end["status"]] = out.get(run.end["status"], 0) + 1
        return out

    def json(self):
        def extremes(low, high):
            if not self.done:
                return {"least": {"value": None, "run": None}, "greatest": {"value": None, "run": None}}
            (a, first), (b, last) = self.extreme(min, low), self.extreme(max, high)
            return {"least": {"value": a, "run": first}, "greatest": {"value": b, "run": last}}

        out = {"verb": "sweep", "title": self.tree.get("title", ""), "runs": len(self.runs), "resumed": 0, "done": len(self.done),
               "ended": self.ended(), "time": CLOCK, "rate": CLOCK}
        return out | {name: extremes(low, high) for name, low, high, _ in self.EXTREMES}

    def lines(self, units):
        count = len(self.runs)
        text = ["reached their end {done}", f"{count} run{'' if count == 1 else 's'}, {{clock .3}} s, {{rate .4}} runs/s"]
        if "title" in self.tree:
            text.append(self.tree["title"])
        text += [f"{CAUSES[status]} {{{status}}}" for status in self.ended()]
        known = []
        if self.done:
            text += ["largest deviation of position (runs that reached their end)", "largest deviation of angle",
                     "largest drive force of a leg, pushing or pulling", "largest speed of a leg", "power of a leg (below 0 the leg brakes)"]
            keys = ", ".join(f"{path}={{{path}}}" for path in self.keys["keys"])
            for which in ("least", "greatest"):
                known += [Line(f"{which} {{{which} {d}}}, run {{run}}: {keys}", units.name, True) for d in ("length", "angle", "force", "speed", "power")]
        return known + [Line(x, units.name) for x in text]

    def facts(self):
        return {"done": Q(len(self.done), None, 0)} | {status: Q(count, None, 0) for status, count in self.ended().items()}

    def compare_rest(self, case, rest, units):
        """The extremes in their order, each with its run and what was set in it."""
        rest.pop("clock", None), rest.pop("rate", None)
        records = rest.pop("records", [])
        wanted = [(which, word, low if which is min else high, d)
                  for _, low, high, d in self.EXTREMES for which, word in ((min, "least"), (max, "greatest"))] if self.done else []
        if len(records) != len(wanted):
            case.fail(f"sweep text: {len(records)} extremes, expected {len(wanted)}")
            return
        for record, (which, word, name, _) in zip(records, wanted):
            best, runs = self.extreme(which, name)
            if word not in record:
                case.fail(f"sweep text: {record} stands where the {word} of {name} should")
                continue
            value, slack = units.of(best)
            case.near(f"sweep text {word} {name}", record[word].value, value, slack, record[word].half)
            number = round(record["run"].value)
            case.same(f"sweep text run of the {word} {name}", number in runs, True)
            for path, setting in self.settings[number - 1].items():
                case.near(f"sweep text {path}", record[path].value, setting, 1e-14 * abs(setting), record[path].half)


# ---- random sweeps --------------------------------------------------------------------------------------------------

def random_sweep(maker, tree):
    """A sweep of two to four runs of a study."""
    r, L, F, T = maker.random, maker.L, maker.F, maker.T
    sizes = {"load.mass": (0.6 * maker.M, 1.5 * maker.M), "motion.amplitude": (0.4, 1.2), "motion.frequency": (0.7, 1.3),
             "initial.heave": (-0.03 * L, 0.03 * L), "initial.yaw": (-2.0, 2.0), "disturbance.vertical_force": (-0.05 * F, 0.05 * F),
             "control.damping": (0.3 * F * T / L, 4 * F * T / L), "control.stiffness": (40 * F / L, 150 * F / L)}
    if "motion" not in tree:
        del sizes["motion.amplitude"], sizes["motion.frequency"]
    if "center_of_mass" in tree["load"]:
        sizes["load.center_of_mass.3"] = (-0.2 * L, 0.2 * L)
    if isinstance(tree.get("control", {}).get("stiffness"), list):
        del sizes["control.stiffness"]
        sizes["control.stiffness.4"] = (40 * F / L, 150 * F / L)
    if isinstance(tree.get("control", {}).get("damping"), list):
        del sizes["control.damping"]
    paths = r.sample(sorted(sizes), r.randint(1, 3))
    inner = {path: (r.uniform(*sizes[path]), r.uniform(*sizes[path])) for path in paths}
    inner = {path: [min(pair), max(pair)] for path, pair in inner.items()}
    plan = r.choice(["product", "zip", "draw"])
    keys, sweep = {}, {"keys": {}}
    count = r.randint(2, 3)
    for k, (path, (low, high)) in enumerate(inner.items()):
        kind = r.choice(["list", "lin", "log", "draw"])
        many = {"product": [count, 2 if count == 2 else 1, 1][k], "zip": count, "draw": 0}[plan]
        if kind == "log" and low <= 0:
            kind = "lin"
        if plan == "draw" or (kind == "draw" and k):
            keys[path] = {"uniform": [low, high]} if r.random() < 0.5 else {"normal": [(low + high) / 2, (high - low) / 8]}
        elif many < 2 or kind in ("list", "draw"):
            keys[path] = [low + (high - low) * x for x in sorted(r.uniform(0, 1) for _ in range(many))]
            r.shuffle(keys[path])
        else:
            keys[path] = {"from": low, "to": high, "steps": many} | ({"scale": "log"} if kind == "log" else {})
    sweep["keys"] = keys
    if all(values_of(key) is None for key in keys.values()):
        sweep["runs"] = count
    if plan == "zip":
        sweep["combine"] = "zip"
    if r.random() < 0.7:
        sweep["seed"] = r.randint(0, 10 ** 14)
    return sweep
