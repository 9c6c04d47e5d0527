"""What a study's verbs should say, computed by mechanics.py: rows, peaks, integrals, ends. SI or the study's units, radians."""
import math

import mechanics as m

ANGLE = 180 / math.pi
REACTIONS = ("rxx", "ryy", "rzz", "rxy", "ryz", "rzx")


class Q:
    """A number of the study with its dimension and how far two honest computations of it may lie apart."""

    def __init__(self, value, dimension, slack):
        self.value, self.dimension, self.slack = value, dimension, slack

    def __repr__(self):
        return f"{self.value!r} ± {self.slack:.1g}"


class Skip:
    """A member of JSON that is not compared, and why."""

    def __init__(self, reason):
        self.reason = reason


class Units:
    """Sizes of the output's units in the study's own."""

    def __init__(self, meaning, scaled):
        self.name = "dimensionless" if scaled or meaning.dimensionless else "si"
        L, M, T = meaning.machine.units() if scaled else (1.0, 1.0, 1.0)
        self.L, self.M, self.T = L, M, T
        self.size = {None: 1.0, "length": L, "time": T, "speed": L / T, "acceleration": L / T ** 2, "force": M * L / T ** 2,
                     "power": M * L ** 2 / T ** 3, "energy": M * L ** 2 / T ** 2, "mass": M, "inertia": M * L ** 2,
                     "stiffness": M / T ** 2, "damping": M / T, "volume": L ** 3, "angle": 1 / ANGLE,
                     "angular speed": 1 / ANGLE / T, "angular acceleration": 1 / ANGLE / T ** 2}

    def of(self, q):
        """Value and slack in these units; angles in degrees."""
        size = self.size[q.dimension]
        return q.value / size, q.slack / size


class Scales:
    """Natural sizes of a study, that slacks are shares of."""

    def __init__(self, meaning):
        self.length, self.time = meaning.machine.base_radius, meaning.duration
        mass, g = meaning.machine.mass, m.norm(meaning.machine.gravity)
        self.force = mass * (g + self.length / self.time ** 2)
        self.size = {None: 1.0, "length": self.length, "time": self.time, "speed": self.length / self.time,
                     "acceleration": self.force / mass, "force": self.force, "power": self.force * self.length / self.time,
                     "energy": self.force * self.length, "angle": 1.0, "angular speed": 1 / self.time,
                     "angular acceleration": self.force / mass / self.length}


# ---- rows -----------------------------------------------------------------------------------------------------------

def row_of(meaning, t, pose, u, wanted=None, axes=None, turn=(0, 0, 0)):
    """One row of a table: name to (value, dimension). wanted: the program's pose, for deviations. axes: principal, for reactions."""
    row = {"t": (t, "time")}

    def put(names, values, dimension):
        for name, value in zip(names.split(), values):
            row[name] = (value, dimension)

    put("x y z", pose.p, "length")
    put("roll pitch yaw", m.angles(pose.R), "angle")
    put("vx vy vz", pose.v, "speed")
    put("wx wy wz", pose.omega, "angular speed")
    put("ax ay az", pose.a, "acceleration")
    put("alx aly alz", pose.alpha, "angular acceleration")
    put("l1 l2 l3 l4 l5 l6", pose.length, "length")
    put("dl1 dl2 dl3 dl4 dl5 dl6", pose.rate, "speed")
    put("f1 f2 f3 f4 f5 f6", u, "force")
    put("p1 p2 p3 p4 p5 p6", [f * v for f, v in zip(u, pose.rate)], "power")
    put("condition", [pose.condition()], None)
    if wanted:
        put("ex ey ez", m.sub(pose.p, wanted.p), "length")
        gaps = [a - b for a, b in zip(m.angles(pose.R), m.angles(wanted.R))]
        put("eroll epitch eyaw", [math.remainder(x, 2 * math.pi) for x in gaps], "angle")
    if axes:
        put(" ".join(REACTIONS), reactions(meaning, pose, u, axes, turn), "energy")
    return row


def reactions(meaning, pose, u, axes, turn):
    """What the axes of the body must be held by: I_a ë_a = Q_a + Σ Λ_ab e_b, with ë of the rigid motion."""
    machine = meaning.machine
    J = machine.inertia
    centre = m.apply(pose.R, machine.centre)
    e = [m.apply(pose.R, a) for a in axes]
    moments = [m.dot(a, m.apply(J, a)) for a in axes]
    second = [sum(moments) / 2 - x for x in moments]  # ∫x² dm = (Jy + Jz − Jx)/2
    acceleration = [m.add(m.cross(pose.alpha, x), m.cross(pose.omega, m.cross(pose.omega, x))) for x in e]
    Q = [m.scaled(0.5, m.cross(turn, x)) for x in e]
    for f, n, arm in zip(u, pose.direction, pose.arm):
        r = m.sub(arm, centre)
        Q = [m.add(q, m.scaled(m.dot(r, x) * f, n)) for q, x in zip(Q, e)]
    held = [m.sub(m.scaled(I, a), q) for I, a, q in zip(second, acceleration, Q)]
    return [m.dot(held[a], e[b]) for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))]


def cubic_integral(values, h):
    """Integral from equally spaced values, each interval by the cubic through the four nearest (Simpson's rule is exact for it)."""
    if len(values) < 4:
        return h * sum((a + b) / 2 for a, b in zip(values, values[1:]))
    total = 0.0
    for i in range(len(values) - 1):
        first = min(max(i - 1, 0), len(values) - 4)
        a, b, c, d = values[first:first + 4]
        middle = {0: (5 * a + 15 * b - 5 * c + d) / 16, 1: (9 * (b + c) - a - d) / 16, 2: (a - 5 * b + 15 * c + 5 * d) / 16}[i - first]
        total += h / 6 * (values[i] + 4 * middle + values[i + 1])
    return total


# ---- quantities of a run along time ---------------------------------------------------------------------------------

LEG_QUANTITIES = ("length", "speed", "force", "power", "square", "base", "top")
DIMENSION = {"length": "length", "speed": "speed", "force": "force", "power": "power", "base": "angle", "top": "angle"}


def quantities(meaning, pose, u):
    """The curves that a summary is made of: (name, leg) to value, and the condition."""
    home, out = meaning.machine.home, {}
    for k in range(6):
        out["length", k], out["speed", k], out["force", k] = pose.length[k], pose.rate[k], u[k]
        out["power", k], out["square", k] = u[k] * pose.rate[k], u[k] * u[k]
        out["base", k] = m.angle_between(pose.direction[k], home.direction[k])
        out["top", k] = m.angle_between(m.apply_back(pose.R, pose.direction[k]), home.direction[k])
    out["condition", 0] = pose.condition()
    return out


class Curves:
    """Each quantity between its samples by the polynomial through the eight nearest: extremes and integrals of the motion itself.

    A piece is a stretch of time without corners: its times and, at each, the quantities; neighbouring pieces share an end."""

    NEAREST, FINE = 8, 6
    GAUSS = [(x, w) for a, w in ((0.3399810435848563, 0.6521451548625461), (0.8611363115940526, 0.3478548451374538))
             for x, w in ((0.5 - a / 2, w / 2), (0.5 + a / 2, w / 2))]

    def __init__(self, pieces):
        self.pieces, self.found = [], {}
        for times, samples in pieces:
            # the end of a step and a row that is due there may differ by round-off: one time
            kept = [i for i in range(len(times)) if i == 0 or times[i] - times[i - 1] > 1e-12 * abs(times[i])]
            times, samples = [times[i] for i in kept], [samples[i] for i in kept]
            cells, fine = [], [times[0]]
            for i in range(len(times) - 1):
                first = max(0, min(i - self.NEAREST // 2 + 1, len(times) - self.NEAREST))
                nodes, low, width = times[first:first + self.NEAREST], times[i], times[i + 1] - times[i]
                inner = [low + width * j / self.FINE for j in range(1, self.FINE)]
                fine += inner + [times[i + 1]]
                gauss = [(width * w, self.weights(nodes, low + width * x)) for x, w in self.GAUSS]
                area = [sum(w * weights[k] for w, weights in gauss) for k in range(len(nodes))]
                cells.append((first, [self.weights(nodes, t) for t in inner], area))
            self.pieces.append((fine, cells, samples))

    @staticmethod
    def weights(nodes, at):
        """Lagrange's polynomials of the nodes at one place."""
        out = []
        for i, x in enumerate(nodes):
            product = 1.0
            for j, y in enumerate(nodes):
                if j != i:
                    product *= (at - y) / (x - y)
            out.append(product)
        return out

    def at(self, name, t):
        """A quantity at one time."""
        times, values = next((x for x in self.curve(name) if x[0][0] <= t <= x[0][-1]), self.curve(name)[-1])
        first = max(0, min(sum(x <= t for x in times) - 2, len(times) - 4))
        return sum(w * v for w, v in zip(self.weights(times[first:first + 4], t), values[first:first + 4]))

    def beyond_rows(self, step, rows):
        """How far a leg's length goes between two rows beyond both of them, at most."""
        most = 0.0
        for leg in range(6):
            ends = [self.at(("length", leg), k * step) for k in range(rows)]
            low, high = [min(x) for x in zip(ends, ends[1:])], [max(x) for x in zip(ends, ends[1:])]
            for times, values in self.curve(("length", leg)):
                for t, v in zip(times, values):
                    k = int(t / step)
                    if k < rows - 1:
                        most = max(most, low[k] - v, v - high[k])
        return most

    def curve(self, name):
        """Of each piece: fine times and the values there."""
        if name not in self.found:
            self.found[name] = []
            for fine, cells, samples in self.pieces:
                nodes = [s[name] for s in samples]
                values = [nodes[0]]
                for i, (first, inner, _) in enumerate(cells):
                    near = nodes[first:first + self.NEAREST]
                    values += [sum(w * v for w, v in zip(weights, near)) for weights in inner] + [nodes[i + 1]]
                self.found[name].append((fine, values))
        return self.found[name]

    def extremes(self, name):
        """Least and greatest value with their times."""
        low = min(peak_of(times, values, 1) for times, values in self.curve(name))
        high = min(peak_of(times, values, -1) for times, values in self.curve(name))
        return low, (-high[0], high[1])

    def integral(self, name):
        total = 0.0
        for _, cells, samples in self.pieces:
            nodes = [s[name] for s in samples]
            for first, _, area in cells:
                total += sum(w * v for w, v in zip(area, nodes[first:first + self.NEAREST]))
        return total

    def worst(self, name, enter, leave, share):
        """The value of the largest share between two times, and when; of equal ones the first."""
        best = -1.0, 0.0, enter
        for times, values in self.curve(name):
            inside = [k for k, t in enumerate(times) if enter <= t <= leave]
            if not inside:
                continue
            first, last = max(inside[0] - 1, 0), min(inside[-1] + 2, len(times))
            for k in inside:
                if share(values[k]) > best[0] * (1 + 1e-12):
                    best = share(values[k]), values[k], times[k]
            for sign in (1, -1):
                value, time = peak_of(times[first:last], values[first:last], sign)
                if share(sign * value) > best[0] * (1 + 1e-12) and enter <= time <= leave:
                    best = share(sign * value), sign * value, time
        return best[1], best[2]

    def intervals(self, name, beyond):
        """Where beyond(value) > 0: [enter, leave] of each interval, leave None where it lasts to the end."""
        out, inside = [], None
        for times, curve in self.curve(name):
            values = [beyond(v) for v in curve]
            for k, t in enumerate(times):
                if inside is None and values[k] > 0:
                    inside = [t if k == 0 else root(times, values, k - 1), None]
                elif inside is not None and values[k] <= 0:
                    inside[1] = root(times, values, k - 1) if k else t
                    out.append(inside)
                    inside = None
        return out + ([inside] if inside is not None else [])


def root(times, values, k):
    """A root between the samples k and k + 1 by the cubic through the values about it."""
    first = min(max(k - 1, 0), len(values) - 4)
    nodes, near = times[first:first + 4], values[first:first + 4]
    low, high, rising = times[k], times[k + 1], values[k + 1] > values[k]
    for _ in range(60):
        middle = (low + high) / 2
        if (sum(w * v for w, v in zip(Curves.weights(nodes, middle), near)) > 0) == rising:
            high = middle
        else:
            low = middle
    return (low + high) / 2


def peak_of(times, values, sign):
    """(least of sign times the values, its time) of a smooth curve by the parabola about its least sample."""
    k = min(range(len(values)), key=lambda i: sign * values[i])
    least = sign * values[k]
    if 0 < k < len(values) - 1:
        left, right = times[k] - times[k - 1], times[k + 1] - times[k]
        before, after = (least - sign * values[k - 1]) / left, (sign * values[k + 1] - least) / right
        bend = (after - before) / (left + right)
        slope = before + bend * left
        if bend > 0 and -left < -slope / (2 * bend) < right:
            return least - slope * slope / (4 * bend), times[k] - slope / (2 * bend)
    return least, times[k]


class Rows:
    """The same quantities at the output times only."""

    def __init__(self, meaning, samples):
        self.step, self.samples = meaning.output_step, samples

    def extremes(self, name):
        values = [s[name] for s in self.samples]
        low, high = min(values), max(values)
        return (low, values.index(low) * self.step), (high, values.index(high) * self.step)

    def integral(self, name):
        return cubic_integral([s[name] for s in self.samples], self.step)


# ---- summaries ------------------------------------------------------------------------------------------------------

def leg_facts(curves, span, scales, slack):
    """What forces and simulate print for each leg: six mappings of names to Q."""
    legs = []
    top = {d: slack * scales.size[d] for d in ("length", "speed", "force", "power", "energy", "angle")}
    for k in range(6):
        for d in ("force", "power"):
            low, high = curves.extremes((d, k))
            top[d] = max(top[d], slack * abs(low[0]), slack * abs(high[0]))
    for k in range(6):
        leg = {}
        for name in ("length", "force", "power"):
            (low, _), (high, _) = curves.extremes((name, k))
            leg[name + "_least"], leg[name + "_greatest"] = Q(low, name, top[name]), Q(high, name, top[name])
        leg["used"] = Q(leg["length_greatest"].value - leg["length_least"].value, "length", top["length"])
        leg["force_peak"] = Q(max(abs(leg["force_least"].value), abs(leg["force_greatest"].value)), "force", top["force"])
        (low, _), (high, _) = curves.extremes(("speed", k))
        leg["speed"] = Q(max(abs(low), abs(high)), "speed", top["speed"])
        square = curves.integral(("square", k))
        leg["rms"] = Q(math.sqrt(max(0.0, square / span)) if span > 0 else leg["force_peak"].value, "force", 3 * top["force"])
        energy = top["energy"] + top["power"] * span
        leg["energy"] = Q(curves.integral(("power", k)), "energy", energy)
        for name in ("base", "top"):
            leg[name] = Q(curves.extremes((name, k))[1][0], "angle", 30 * top["angle"])
        legs.append(leg)
    return legs


def over_all(legs):
    """The row `all` of the tables."""
    least = {"length_least", "force_least", "power_least"}
    out = {}
    for name, first in legs[0].items():
        values, slack = [leg[name].value for leg in legs], max(leg[name].slack for leg in legs)
        if name == "energy":
            out[name] = Q(sum(values), "energy", 6 * slack)
        else:
            out[name] = Q(min(values) if name in least else max(values), first.dimension, slack)
    return out
