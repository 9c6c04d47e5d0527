"""What a study's verbs should say, computed by mechanics.py: rows, peaks, integrals, ends. SI or the study's units, radians."""
import bisect
import math

import mechanics as m

ANGLE = 180 / math.pi
REACTIONS = ("rxx", "ryy", "rzz", "rxy", "ryz", "rzx")
JOINTS = tuple([f"h{k}" for k in range(1, 7)] + [f"{end}{axis}{k}" for end in "tb" for k in range(1, 7) for axis in "xyz"]
               + [f"s{k}" for k in range(1, 7)])


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
    # legs without mass and friction: what their drives give goes along them to both ends
    ends = [f * x for f, n in zip(u, pose.direction) for x in n]
    put(" ".join(JOINTS), [*u, *ends, *ends, *([0.0] * 6)], "force")
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


# ---- quantities of a run along time ---------------------------------------------------------------------------------

LEG_QUANTITIES = ("length", "speed", "force", "power", "square", "base", "top")
DIMENSION = {"length": "length", "speed": "speed", "force": "force", "power": "power", "base": "angle", "top": "angle"}


def quantities(meaning, pose, u):
    """The curves that a summary is made of: (name, leg) to value, and the condition."""
    home, out = meaning.machine.home, {}
    for k in range(6):
        out["length", k], out["speed", k], out["force", k], out["power", k] = pose.length[k], pose.rate[k], u[k], u[k] * pose.rate[k]
        out["base", k] = m.angle_between(pose.direction[k], home.direction[k])
        out["top", k] = m.angle_between(m.apply_back(pose.R, pose.direction[k]), home.direction[k])
    return Sample(pose, out)


class Sample(dict):
    """The quantities of a pose with its leg forces; the condition, which takes longest, when it is asked for."""

    def __init__(self, pose, numbers):
        super().__init__(numbers)
        self.pose = pose

    def __missing__(self, name):
        if name != ("condition", 0):
            raise KeyError(name)
        self[name] = self.pose.condition()
        return self[name]


class Curves:
    """Extremes and integrals of quantities of the motion, from the motion itself at any time.

    A piece is a stretch of time without corners: times, and a function from a time in it to the quantities. The time from one to the
    next is a cell, with samples at the places of Lobatto's rule of five; neighbouring pieces share an end."""

    INNER = [(1 - math.sqrt(3 / 7)) / 2, 0.5, (1 + math.sqrt(3 / 7)) / 2]
    WEIGHTS = [1 / 20, 49 / 180, 16 / 45, 49 / 180, 1 / 20]
    CELL = len(INNER) + 1

    def __init__(self, pieces):
        self.pieces = []
        for times, exact in pieces:
            dense = [low + (high - low) * x for low, high in zip(times, times[1:]) for x in (0.0, *self.INNER)] + [times[-1]]
            self.pieces.append((dense, [exact(t) for t in dense], exact))

    def at(self, name, t):
        """A quantity at one time."""
        exact = next((exact for times, _, exact in self.pieces if times[0] <= t <= times[-1]), self.pieces[-1][2])
        return exact(t)[name]

    def beyond_rows(self, step, rows):
        """How far a leg's length goes between two rows beyond both of them, at most."""
        most = 0.0
        ends = [[self.at(("length", leg), k * step) for leg in range(6)] for k in range(rows)]
        for leg in range(6):
            low, high = [min(a[leg], b[leg]) for a, b in zip(ends, ends[1:])], [max(a[leg], b[leg]) for a, b in zip(ends, ends[1:])]
            for times, samples, _ in self.pieces:
                for t, s in zip(times, samples):
                    k = int(t / step)
                    if k < rows - 1:
                        most = max(most, low[k] - s["length", leg], s["length", leg] - high[k])
        return most

    def nodes(self, name, piece):
        """Times and values of a quantity: the condition bends slowly, and is expensive, so it has fewer."""
        times, samples, _ = piece
        every = self.CELL if name == ("condition", 0) and len(times) > 5 * self.CELL else 1
        return times[::every], [s[name] for s in samples[::every]]

    def extremes(self, name):
        """Least and greatest value with their times."""
        low = min(self.peak(name, piece, 1) for piece in self.pieces)
        high = min(self.peak(name, piece, -1) for piece in self.pieces)
        return low, (-high[0], high[1])

    def peak(self, name, piece, sign):
        """(least of sign times a quantity in a piece, its time). Of the least samples, those nearly as low are looked into."""
        times, values = self.nodes(name, piece)
        values = [sign * v for v in values]
        best = min((v, t) for v, t in zip(values, times))
        near = best[0] + 0.02 * (max(values) - best[0])
        for i, v in enumerate(values):
            if v <= near and (i == 0 or v <= values[i - 1]) and (i == len(values) - 1 or v <= values[i + 1]) and len(values) > 2:
                first = min(max(i - 1, 0), len(values) - 3)
                best = min(best, refined(times[first:first + 3], values[first:first + 3], lambda t: sign * piece[2](t)[name]))
        return best

    def integral(self, name):
        total = 0.0
        for times, samples, _ in self.pieces:
            for i in range(0, len(times) - 1, self.CELL):
                cell = samples[i:i + self.CELL + 1]
                if name[0] == "square":
                    total += (times[i + self.CELL] - times[i]) * sum(w * s["force", name[1]] ** 2 for w, s in zip(self.WEIGHTS, cell))
                else:
                    total += (times[i + self.CELL] - times[i]) * sum(w * s[name] for w, s in zip(self.WEIGHTS, cell))
        return total

    def returned(self, name):
        """−∫ min(x, 0) of a quantity: by the polynomial through the samples of a cell, in small steps where it changes its sign."""
        total, places, steps = 0.0, (0.0, *self.INNER, 1.0), 400
        for times, samples, _ in self.pieces:
            for i in range(0, len(times) - 1, self.CELL):
                values, length = [s[name] for s in samples[i:i + self.CELL + 1]], times[i + self.CELL] - times[i]
                if max(values) <= 0 or min(values) >= 0:
                    total -= length * min(0.0, sum(w * v for w, v in zip(self.WEIGHTS, values)))
                    continue
                coefficient = list(values)  # Newton's divided differences
                for order in range(1, len(places)):
                    for k in range(len(places) - 1, order - 1, -1):
                        coefficient[k] = (coefficient[k] - coefficient[k - 1]) / (places[k] - places[k - order])
                for k in range(steps):
                    x, value = (k + 0.5) / steps, 0.0
                    for c, place in zip(coefficient[::-1], places[::-1]):
                        value = value * (x - place) + c
                    total -= length / steps * min(0.0, value)
        return total

    def worst(self, name, enter, leave, share):
        """The value of the largest share between two times, and when."""
        found = []
        for times, samples, exact in self.pieces:
            inside = [t for t in times if enter < t < leave]
            ends = [t for t in (enter, leave) if times[0] <= t <= times[-1]]
            places = sorted({*inside, *ends})
            values = [-share(exact(t)[name]) for t in places]
            found += list(zip(values, places))
            for i in range(len(places)):
                first = min(max(i - 1, 0), len(places) - 3)
                if first >= 0 and values[i] <= min(values[max(i - 1, 0):i + 2]):
                    found.append(refined(places[first:first + 3], values[first:first + 3], lambda t, exact=exact: -share(exact(t)[name])))
        time = min(found)[1]
        return self.at(name, time), time

    def intervals(self, name, beyond):
        """Where beyond(value) > 0: [enter, leave] of each interval, leave None where it lasts to the end."""
        out, inside = [], None
        for times, samples, exact in self.pieces:
            values = [beyond(s[name]) for s in samples]
            function = lambda t, exact=exact: beyond(exact(t)[name])
            for k, t in enumerate(times):
                if inside is None and values[k] > 0:
                    inside = [t if k == 0 else root(times[k - 1], t, function), None]
                elif inside is not None and values[k] <= 0:
                    inside[1] = root(times[k - 1], t, function) if k else t
                    out.append(inside)
                    inside = None
        return out + ([inside] if inside is not None else [])


def root(low, high, function):
    """Where a function changes its sign."""
    rising = function(high) > 0
    for _ in range(48):
        middle = (low + high) / 2
        if (function(middle) > 0) == rising:
            high = middle
        else:
            low = middle
    return high


def vertex(times, values):
    """(value, time) at the vertex of the parabola through three points; None where it opens downward."""
    left, right = times[1] - times[0], times[2] - times[1]
    before, after = (values[1] - values[0]) / left, (values[2] - values[1]) / right
    bend = (after - before) / (left + right)
    slope = before + bend * left
    return (values[1] - slope * slope / (4 * bend), times[1] - slope / (2 * bend)) if bend > 0 else None


def refined(times, values, function):
    """The least value of a smooth function about the least of three places, by parabolas through ever nearer places."""
    best, low, high = min(zip(values, times)), times[0], times[2]
    width = (high - low) / 2
    for _ in range(3):
        found = vertex(times, values)
        if found is None or not low < found[1] < high:
            return best
        width /= 12
        at = min(max(found[1], low + width), high - width)
        times = [at - width, at, at + width]
        values = [function(t) for t in times]
        best = min(best, *zip(values, times))
    found = vertex(times, values)
    return min(best, found) if found and times[0] < found[1] < times[2] else best


class States:
    """States of a run at any time of a piece: Hermite's polynomial through the six nearest states and their derivatives."""

    NEAREST = 6

    def __init__(self, times, states, slopes):
        self.times, self.states, self.slopes, self.found = times, states, slopes, {}

    def at(self, t):
        last = len(self.times) - 1
        i = min(max(bisect.bisect_right(self.times, t) - 1, 0), max(last - 1, 0))
        first = max(0, min(i - self.NEAREST // 2 + 1, last + 1 - self.NEAREST))
        if first not in self.found:
            self.found[first] = self.differences(first, min(first + self.NEAREST, last + 1))
        doubled, table = self.found[first]
        out = table[-1]
        for x, row in zip(doubled[-2::-1], table[-2::-1]):
            out = [c + (t - x) * v for c, v in zip(row, out)]
        return tuple(out)

    def differences(self, first, end):
        """Newton's divided differences of doubled nodes: the places, and a coefficient of each degree."""
        doubled = [t for t in self.times[first:end] for _ in (0, 1)]
        column = [s for s in self.states[first:end] for _ in (0, 1)]
        out = [column[0]]
        for order in range(1, len(doubled)):
            new = []
            for i in range(len(column) - 1):
                gap = doubled[i + order] - doubled[i]
                new.append(self.slopes[first + i // 2] if gap == 0 else [(b - a) / gap for a, b in zip(column[i], column[i + 1])])
            column = new
            out.append(column[0])
        return doubled, out


class Instant:
    """The same quantities where a run ends at its beginning."""

    def __init__(self, sample):
        self.sample = sample

    def extremes(self, name):
        return (self.sample[name], 0.0), (self.sample[name], 0.0)

    def integral(self, name):
        return 0.0

    def returned(self, name):
        return 0.0


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
        leg["returned"] = Q(curves.returned(("power", k)), "energy", 4 * energy)
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
        if name in ("energy", "returned"):
            out[name] = Q(sum(values), "energy", 6 * slack)
        else:
            out[name] = Q(min(values) if name in least else max(values), first.dimension, slack)
    return out
