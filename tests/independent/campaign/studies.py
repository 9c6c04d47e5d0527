"""Random studies: what a study file says, as a tree of keys, and what it means, as a machine and its motion.

A tree is what is written to the file, in the file's units and degrees. `Meaning` reads a tree by the guide's tables of keys and
knows nothing of the library's reader. Sweeps change numbers of a tree and read it again.
"""
import copy
import json
import math
import random as random_module
import statistics

import formulas
import mechanics as m

COMPONENTS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
DEGREE = math.pi / 180


# ---- the file -------------------------------------------------------------------------------------------------------

def written(tree):
    """The study as YAML: one key a line, its value in flow style."""
    def plain(x):
        if isinstance(x, formulas.Formula):
            return x.text
        if isinstance(x, dict):
            return {k: plain(v) for k, v in x.items()}
        return [plain(v) for v in x] if isinstance(x, (list, tuple)) else x
    return "".join(f"{key}: {json.dumps(plain(value))}\n" for key, value in tree.items())


def changed(tree, settings):
    """A copy of a tree with numbers put at paths such as load.mass or load.center_of_mass.3."""
    tree = copy.deepcopy(tree)
    for path, value in settings.items():
        place = tree
        *way, last = path.split(".")
        for word in way:
            place = place[int(word) - 1] if isinstance(place, list) else place.setdefault(word, {})
        place[int(last) - 1 if isinstance(place, list) else last] = value
    return tree


# ---- random numbers by counting -------------------------------------------------------------------------------------

def philox(seed, run, draw):
    """53 bits of Philox 4 x 32 with ten rounds; the counter is (draw, run), the key the seed."""
    low, word = 0xFFFFFFFF, 32
    a, b, c, d = draw & low, draw >> word, run & low, run >> word
    k, l = seed & low, seed >> word
    for _ in range(10):
        first, second = 0xD2511F53 * a, 0xCD9E8D57 * c
        a, b, c, d = (second >> word) ^ b ^ k, second & low, (first >> word) ^ d ^ l, first & low
        k, l = (k + 0x9E3779B9) & low, (l + 0xBB67AE85) & low
    return ((b << word) | a) >> 11


def uniform(seed, run, draw):
    return philox(seed, run, draw) / 2 ** 53


def normal(seed, run, draw):
    """By Wichura's rational functions (AS 241), as the standard library has them."""
    return statistics.NormalDist().inv_cdf((philox(seed, run, draw) + 0.5) / 2 ** 53)


class Noise:
    """Twelve channels of a uniform cubic B-spline over random numbers: six legs, force, moment."""

    def __init__(self, keys, run):
        self.interval, self.seed, self.run = keys["interval"], keys.get("seed", 0), run
        sizes = [keys.get("leg_force", 0)] * 6 + [keys.get("force", 0)] * 3 + [keys.get("moment", 0)] * 3
        self.size = [math.sqrt(315 / 151) * s for s in sizes]
        self.drawn = {}

    def coefficient(self, channel, knot):
        if (channel, knot) not in self.drawn:
            self.drawn[channel, knot] = normal(self.seed, self.run, channel + 12 * knot)
        return self.drawn[channel, knot]

    def at(self, t):
        knot = math.floor(t / self.interval)
        x = t / self.interval - knot
        y = 1 - x
        weight = (y ** 3 / 6, (3 * x ** 3 - 6 * x * x + 4) / 6, (3 * y ** 3 - 6 * y * y + 4) / 6, x ** 3 / 6)
        return [size * sum(w * self.coefficient(c, knot + k) for k, w in enumerate(weight)) if size else 0.0
                for c, size in enumerate(self.size)]


# ---- what a tree means ----------------------------------------------------------------------------------------------

def ring(keys, first):
    """Six joints of a ring by radius and half angle, the pairs about `first` and 120 and 240 degrees on."""
    if "joints" in keys:
        return [tuple(p) for p in keys["joints"]]
    out = []
    for leg in range(6):
        # base: +half, 120 − half, 120 + half, 240 − half …; top: 60 − half, 60 + half, 180 − half …
        if first == 0:
            angle = (leg + 1) // 2 * 120 + (keys["half_angle"] if leg % 2 == 0 else -keys["half_angle"])
        else:
            angle = 60 + leg // 2 * 120 + (-keys["half_angle"] if leg % 2 == 0 else keys["half_angle"])
        out.append((keys["radius"] * math.cos(angle * DEGREE), keys["radius"] * math.sin(angle * DEGREE), 0.0))
    return out


def six(value):
    return list(value) if isinstance(value, (list, tuple)) else [value] * 6


def of_time(value):
    """A formula, or a plain number as one."""
    return value if isinstance(value, formulas.Formula) else formulas.number(value)


class Meaning:
    def __init__(self, tree, noise_run=0):
        self.tree = tree
        self.dimensionless = tree.get("units") == "dimensionless"
        platform, load = tree["platform"], tree["load"]
        gravity = tree.get("gravity", 1.0 if self.dimensionless else 9.80665)
        gravity = tuple(gravity) if isinstance(gravity, (list, tuple)) else (0.0, 0.0, -gravity)
        inertia = load["inertia"]
        if not isinstance(inertia[0], (list, tuple)):
            inertia = [[inertia[i] if i == j else 0.0 for j in range(3)] for i in range(3)]
        motion = tree.get("motion", {})
        self.machine = m.Machine(ring(platform["base"], 0), ring(platform["top"], 60), platform["height"], load["mass"],
                                 tuple(load.get("center_of_mass", (0, 0, 0))), tuple(map(tuple, inertia)), gravity,
                                 tuple(motion.get("about", (0, 0, 0))))
        self.limits = platform.get("legs", {})
        self.amplitude, self.frequency = motion.get("amplitude", 1), motion.get("frequency", 1)
        self.moves = motion.get("moves")
        self.read_program(motion)
        control = tree.get("control", {})
        self.feedforward = control.get("feedforward", "program") == "program"
        self.stiffness, self.damping = six(control.get("stiffness", 0)), six(control.get("damping", 0))
        self.read_disturbance(tree.get("disturbance", {}), noise_run)
        simulation = tree.get("simulation", {})
        self.duration, self.output_step = simulation.get("duration", 20), simulation.get("output_step", 0.05)
        self.method, self.step = simulation.get("method", "dop853"), simulation.get("step")
        self.tolerance = simulation.get("tolerance", 1e-10)
        self.constraints = simulation.get("constraints", "projection")
        self.rows = math.floor(self.duration / self.output_step + 1e-9) + 1
        self.plant = m.Plant(self.machine, self.program, self.feedforward, self.stiffness, self.damping,
                             self.disturbance_at if self.disturbed else None)
        stops = set(self.corners)
        if self.noise:
            stops |= {k * self.noise.interval for k in range(int(self.duration / self.noise.interval) + 1)}
        self.stops = sorted(t for t in stops if 0 < t < self.duration)

    def time(self, row):
        return row * self.output_step

    def read_program(self, motion):
        self.corners = set()
        if self.moves is not None:
            for move in self.moves:
                self.corners |= {move["start"] / self.frequency, (move["start"] + move["duration"]) / self.frequency}
            return
        self.component = [of_time(motion.get(name, 0.0)) for name in COMPONENTS]
        for component in self.component:
            self.corners |= {t / self.frequency for t in component.corners}

    def moved(self, t):
        """Jets of point-to-point moves in their own time."""
        jets = [[0.0, 0.0, 0.0] for _ in COMPONENTS]
        for move in self.moves:
            s, ds, dds = formulas.quintic((t - move["start"]) / move["duration"])
            for k, name in enumerate(COMPONENTS):
                if name in move and t > move["start"]:
                    before = jets[k][0]
                    way = move[name] - before
                    jets[k] = [before + way * s, way * ds / move["duration"], way * dds / move["duration"] ** 2]
        return jets

    def program(self, t):
        """Jets of surge … yaw at t, angles in radians."""
        inner = self.frequency * t
        jets = self.moved(inner) if self.moves is not None else [c.jet(inner) for c in self.component]
        out = []
        for k, (f, df, ddf) in enumerate(jets):
            size = self.amplitude * (DEGREE if k > 2 else 1)
            out.append((size * f, size * self.frequency * df, size * self.frequency ** 2 * ddf))
        return out

    def read_disturbance(self, keys, noise_run):
        self.leg_force = [of_time(x) for x in six(keys.get("leg_force", 0.0))]
        self.vertical = of_time(keys.get("vertical_force", 0.0))
        self.force = [of_time(x) for x in keys.get("force", (0.0,) * 3)]
        self.moment = [of_time(x) for x in keys.get("moment", (0.0,) * 3)]
        noise = keys.get("noise")
        self.noise = Noise(noise, noise.get("run", noise_run)) if noise else None
        self.disturbed = bool(keys)
        for formula in (*self.leg_force, self.vertical, *self.force, *self.moment):
            self.corners |= set(formula.corners)

    def disturbance_at(self, t):
        noise = self.noise.at(t) if self.noise else (0.0,) * 12
        return ([f.jet(t)[0] + n for f, n in zip(self.leg_force, noise)], self.vertical.jet(t)[0],
                tuple(f.jet(t)[0] + n for f, n in zip(self.force, noise[6:9])),
                tuple(f.jet(t)[0] + n for f, n in zip(self.moment, noise[9:12])))

    def start(self):
        """State at t = 0: the program's, with what `initial` puts in its place."""
        initial = self.tree.get("initial", {})
        jets = self.program(0.0)
        pose = self.machine.program_pose(jets)
        given = [initial.get(name) for name in COMPONENTS]
        s = [jets[k][0] if given[k] is None else given[k] for k in range(3)]
        turn = [jets[k][0] if given[k] is None else given[k] * DEGREE for k in range(3, 6)]
        velocity = tuple(initial.get("velocity", [jets[k][1] for k in range(3)]))
        omega = tuple(x * DEGREE for x in initial["angular_velocity"]) if "angular_velocity" in initial else pose.omega
        q = m.quaternion(*turn)
        R = m.rotation_of_quaternion(q)
        arm = m.apply(R, m.sub(self.machine.centre, self.machine.about))
        centre = m.add(m.add(m.add((0, 0, self.machine.height), self.machine.about), s), arm)
        return (*centre, *q, *m.add(velocity, m.cross(omega, arm)), *m.apply_back(R, omega))


# ---- random trees ---------------------------------------------------------------------------------------------------

class Maker:
    """Makes one random study of size L, mass M and time T = sqrt(L/g), of which everything else is a moderate multiple."""

    def __init__(self, seed, number):
        self.random = random_module.Random(f"{seed}:{number}")
        self.number = number

    def make(self):
        while True:
            tree = self.tree()
            try:
                meaning = Meaning(tree)
                if self.sound(meaning):
                    self.add_limits(tree, meaning)
                    return tree
            except (ZeroDivisionError, ValueError, OverflowError, TypeError):
                continue

    def sound(self, meaning):
        """Well conditioned at home and along the program, legs of some length, forces not cancelling to nothing."""
        machine = meaning.machine
        if machine.home.condition() > 60:
            return False
        for k in range(25):
            pose = machine.program_pose(meaning.program(k / 24 * meaning.duration))
            if pose.condition() > 200 or min(pose.length) < 0.15 * self.L:
                return False
        return True

    def tree(self):
        r = self.random
        self.dimensionless = r.random() < 0.15
        self.L = 1.0 if self.dimensionless else r.choice([0.004, 0.07, 0.4, 1.3, 9.0, 350.0, 2.0e4]) * r.uniform(0.6, 1.6)
        self.M = 1.0 if self.dimensionless else r.choice([1e-4, 0.3, 12.0, 900.0, 2e5]) * r.uniform(0.5, 2)
        g = 1.0 if self.dimensionless else 9.80665
        self.T = math.sqrt(self.L / g)
        self.F = self.M * g
        tree = {"title": f"random study {self.number}"} if r.random() < 0.8 else {}
        if self.dimensionless:
            tree["units"] = "dimensionless"
        elif r.random() < 0.5:
            tree["units"] = "si"
        tree["platform"], tree["load"] = self.platform(), self.load()
        gravity = self.gravity(g)
        if gravity is not None:
            tree["gravity"] = gravity
        tree["simulation"] = self.simulation()
        motion = self.motion()
        if motion:
            tree["motion"] = motion
        control = self.control()
        if control:
            tree["control"] = control
        disturbance = self.disturbance()
        if disturbance:
            tree["disturbance"] = disturbance
        if r.random() < 0.25:
            tree["initial"] = self.initial()
        return tree

    def point(self, size):
        return [self.random.uniform(-size, size) * self.L for _ in range(3)]

    def platform(self):
        r, L = self.random, self.L
        base, top = {"radius": L, "half_angle": r.uniform(3, 25)}, {"radius": r.uniform(0.4, 1.1) * L, "half_angle": r.uniform(3, 25)}
        for keys, first, share in ((base, 0, 0.3), (top, 60, 0.3)):
            if r.random() < share:
                joints = [[x + dx for x, dx in zip(p, self.point(0.12))] for p in ring(keys, first)]
                keys.clear()
                keys["joints"] = joints
        height = r.uniform(0.7, 1.6) * L
        return {"base": base, "top": top, "height": -height if r.random() < 0.15 else height}

    def load(self):
        r, L, M = self.random, self.L, self.M
        load = {"mass": M}
        if r.random() < 0.8:
            load["center_of_mass"] = self.point(0.3)
        # the inertia of a cloud of points is that of a body
        cloud = [[r.uniform(-0.6, 0.6) * L for _ in range(3)] for _ in range(6)]
        J = [[sum((m.dot(p, p) if i == j else 0) - p[i] * p[j] for p in cloud) * M / 6 for j in range(3)] for i in range(3)]
        load["inertia"] = J if r.random() < 0.6 else [J[k][k] for k in range(3)]
        return load

    def gravity(self, g):
        r = self.random
        kind = r.random()
        if kind < 0.5:
            return None
        if kind < 0.62:
            return 0
        if kind < 0.78:
            return g * r.uniform(0.1, 1.5)
        return [r.uniform(-0.6, 0.6) * g, r.uniform(-0.6, 0.6) * g, r.uniform(-1.2, 0.8) * g]

    def simulation(self):
        r = self.random
        steps = r.choice([20, 28, 36])
        self.duration = r.uniform(1.0, 2.2) * self.T
        out = {"output_step": self.duration / steps, "duration": self.duration * (1 if r.random() < 0.7 else 1.007)}
        method = r.choice(["dop853", "dop853", "dop853", "dop853 step", "rk4", "rattle6"]).split()
        if method != ["dop853"] or r.random() < 0.5:
            out["method"] = method[0]
        if method == ["dop853"]:
            out["tolerance"] = 1e-12
        else:
            out["step"] = out["output_step"] / {"dop853": 20, "rk4": 90, "rattle6": 48}[method[0]]
        if not method[0].startswith("rattle"):
            if r.random() < 0.2:
                out["constraints"] = r.choice(["none", {"baumgarte": [1.0 / self.T, 2.0 / self.T]}])
        return out

    def motion(self):
        r, L, T = self.random, self.L, self.T
        motion = {}
        if r.random() < 0.06:
            return motion
        sizes = [0.12 * L] * 3 + [9.0] * 3
        if r.random() < 0.25:
            start, motion["moves"] = 0.0, []
            for _ in range(r.randint(1, 3)):
                start += r.uniform(0, 0.3) * T
                move = {"start": start, "duration": r.uniform(0.5, 1.2) * T}
                start += move["duration"]
                for k in r.sample(range(6), r.randint(1, 4)):
                    move[COMPONENTS[k]] = sizes[k] * r.uniform(-1, 1)
                motion["moves"].append(move)
        else:
            for k in r.sample(range(6), r.randint(1, 6)):
                shape = formulas.random_shape(r, T, calm=r.random() < 0.5)
                motion[COMPONENTS[k]] = formulas.number(sizes[k] * r.uniform(-1, 1)) * shape
        if r.random() < 0.4:
            motion["about"] = self.point(0.3)
        if r.random() < 0.2:
            motion["amplitude"] = r.uniform(0.5, 1.3)
        if r.random() < 0.2:
            motion["frequency"] = r.uniform(0.7, 1.4)
        return motion

    def gain(self, low, high, unit):
        r = self.random
        values = [math.exp(r.uniform(math.log(low), math.log(high))) * unit]
        return values[0] if r.random() < 0.7 else [values[0] * r.uniform(0.7, 1.4) for _ in range(6)]

    def control(self):
        r = self.random
        if r.random() < 0.2:
            return {}
        control = {"stiffness": self.gain(3, 120, self.F / self.L)}
        if r.random() < 0.6:
            control["damping"] = self.gain(0.3, 5, self.F * self.T / self.L)
        if r.random() < 0.25:
            control["feedforward"] = "none"
            control["stiffness"] = self.gain(60, 200, self.F / self.L)
        return control

    def formula(self, size):
        r = self.random
        if r.random() < 0.15:
            return size * r.uniform(-1, 1)
        return formulas.number(size * r.uniform(-1, 1)) * formulas.random_shape(r, self.T)

    def disturbance(self):
        r, F, L = self.random, self.F, self.L
        keys = {}
        if r.random() < 0.3:
            keys["leg_force"] = self.formula(0.02 * F) if r.random() < 0.5 else [self.formula(0.02 * F) for _ in range(6)]
        if r.random() < 0.2:
            keys["vertical_force"] = self.formula(0.05 * F)
        if r.random() < 0.3:
            keys["force"] = [self.formula(0.05 * F) for _ in range(3)]
        if r.random() < 0.3:
            keys["moment"] = [self.formula(0.02 * F * L) for _ in range(3)]
        if r.random() < 0.15:
            keys["noise"] = {"interval": r.uniform(0.1, 0.4) * self.T, "leg_force": 0.01 * F, "force": 0.01 * F,
                             "moment": 0.005 * F * L, "seed": r.randint(0, 10 ** 12)}
            if r.random() < 0.5:
                keys["noise"]["run"] = r.randint(0, 1000)
        return keys

    def initial(self):
        r, L, T = self.random, self.L, self.T
        keys = {}
        for k, name in enumerate(COMPONENTS):
            if r.random() < 0.4:
                keys[name] = r.uniform(-1, 1) * (0.05 * L if k < 3 else 3.0)
        if r.random() < 0.4:
            keys["velocity"] = [r.uniform(-0.1, 0.1) * L / T for _ in range(3)]
        if r.random() < 0.4:
            keys["angular_velocity"] = [r.uniform(-5, 5) / T for _ in range(3)]
        return keys

    def add_limits(self, tree, meaning):
        """Limits of the legs, some well beyond what the program needs and some within it."""
        r = self.random
        if r.random() < 0.45:
            return
        poses = [meaning.plant.program_pose(k / 60 * meaning.duration) for k in range(61)]
        lengths = [x for p in poses for x in p.length]
        speeds = max(abs(x) for p in poses for x in p.rate)
        force = max(abs(x) for p in poses for x in meaning.plant.program_forces(p))
        keys, room = {}, max(max(lengths) - min(lengths), 0.05 * self.L)
        if r.random() < 0.7:
            keys["length"] = [max(0.0, min(lengths) - room * r.choice([0.5, 0.8, -0.13])), max(lengths) + room * r.choice([0.6, 1.5, -0.17])]
        if r.random() < 0.4 and speeds > 1e-3 * self.L / self.T:
            keys["max_speed"] = speeds * r.choice([1.6, 2.5, 0.83])
        if r.random() < 0.5:
            keys["max_force"] = max(force, 0.05 * self.F) * r.choice([1.7, 2.5, 0.87])
        if keys:
            tree["platform"]["legs"] = keys
