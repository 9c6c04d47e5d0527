"""Formulas of time as text for a study file and, beside it, their value and two derivatives by rules written here.

An expression is a pair of its text and a function of t that returns (f, f', f''). Each rule of differentiation is written out
where it is used: sums, products, and a function of one argument by its own first and second derivative.
"""
import math


class Formula:
    def __init__(self, text, jet, corners=()):
        self.text, self.jet, self.corners = text, jet, tuple(corners)  # corners: times where the third derivative jumps

    def __add__(self, other):
        f, g = self.jet, other.jet
        return Formula(f"({self.text} + {other.text})", lambda t: tuple(a + b for a, b in zip(f(t), g(t))),
                       self.corners + other.corners)

    def __sub__(self, other):
        f, g = self.jet, other.jet
        return Formula(f"({self.text} - {other.text})", lambda t: tuple(a - b for a, b in zip(f(t), g(t))),
                       self.corners + other.corners)

    def __mul__(self, other):
        def jet(t):
            a, da, dda = self.jet(t)
            b, db, ddb = other.jet(t)
            return a * b, da * b + a * db, dda * b + 2 * da * db + a * ddb
        return Formula(f"{self.text}*{other.text}", jet, self.corners + other.corners)

    def __truediv__(self, other):
        def jet(t):
            a, da, dda = self.jet(t)
            b, db, ddb = other.jet(t)
            q = a / b
            dq = (da - q * db) / b
            return q, dq, (dda - 2 * dq * db - q * ddb) / b
        return Formula(f"{self.text}/{other.text}", jet, self.corners + other.corners)

    def squared(self):
        product = self * self
        return Formula(f"({self.text})^2", product.jet, self.corners)


def number(x):
    return Formula(repr(x) if x >= 0 else f"({x!r})", lambda t: (x, 0.0, 0.0))


TIME = Formula("t", lambda t: (t, 1.0, 0.0))


def composed(name, inner, outer):
    """outer(x) gives the function, its first and its second derivative at x."""
    def jet(t):
        x, dx, ddx = inner.jet(t)
        f, df, ddf = outer(x)
        return f, df * dx, ddf * dx * dx + df * ddx
    return Formula(f"{name}({inner.text})", jet, inner.corners)


def sin(e):
    return composed("sin", e, lambda x: (math.sin(x), math.cos(x), -math.sin(x)))


def cos(e):
    return composed("cos", e, lambda x: (math.cos(x), -math.sin(x), -math.cos(x)))


def exp(e):
    return composed("exp", e, lambda x: (math.exp(x),) * 3)


def log(e):
    return composed("log", e, lambda x: (math.log(x), 1 / x, -1 / (x * x)))


def sqrt(e):
    return composed("sqrt", e, lambda x: (math.sqrt(x), 0.5 / math.sqrt(x), -0.25 / x ** 1.5))


def tanh(e):
    def outer(x):
        y = math.tanh(x)
        return y, 1 - y * y, -2 * y * (1 - y * y)
    return composed("tanh", e, outer)


def atan(e):
    return composed("atan", e, lambda x: (math.atan(x), 1 / (1 + x * x), -2 * x / (1 + x * x) ** 2))


def asin(e):
    return composed("asin", e, lambda x: (math.asin(x), (1 - x * x) ** -0.5, x * (1 - x * x) ** -1.5))


def quintic(x):
    """Minimum jerk from 0 to 1 while x does: value, first and second derivative."""
    if x <= 0:
        return 0.0, 0.0, 0.0
    if x >= 1:
        return 1.0, 0.0, 0.0
    return x ** 3 * (10 + x * (6 * x - 15)), 30 * (x * (1 - x)) ** 2, 60 * x * (1 - x) * (1 - 2 * x)


def ramp(start, duration):
    """ramp(t - start, duration)"""
    def jet(t):
        s, ds, dds = quintic((t - start) / duration)
        return s, ds / duration, dds / duration ** 2
    shift = f"t - {start!r}" if start > 0 else "t"
    return Formula(f"ramp({shift}, {duration!r})", jet, (start, start + duration))


def random_shape(random, T, calm=False):
    """A formula of size 1 and time scale T. calm: starts from rest at 0."""
    w, phase = random.uniform(0.7, 3.0) / T, random.uniform(-3, 3)
    sine = sin(number(w) * TIME + number(phase))
    start, duration = random.uniform(0.1, 1.2) * T, random.uniform(0.5, 2.0) * T
    shapes = [
        lambda: sin(number(w) * TIME) * ramp(0.0, 2 * duration),
        lambda: number(0.5) * (number(1.0) - cos(number(w) * TIME)),
        lambda: ramp(start, duration) - number(0.5) * ramp(start + duration, duration),
        lambda: (TIME / number(2 * T)).squared() * (number(1.5) - TIME / number(2 * T)),
        lambda: sine,
        lambda: sine + number(0.3) * sin(number(2.7 * w) * TIME),
        lambda: exp(number(-1.0) * ((TIME - number(start)) / number(duration)).squared()),
        lambda: tanh((TIME - number(start)) / number(duration)),
        lambda: atan((TIME - number(start)) / number(duration)) * number(0.6),
        lambda: log(number(1.0) + (TIME / number(T)).squared()) * number(0.5),
        lambda: sqrt(number(1.0) + (TIME / number(T)).squared()) - number(1.0),
        lambda: asin(number(0.7) * sin(number(w) * TIME)),
        lambda: sine * exp(number(-0.4 / T) * TIME),
    ]
    return random.choice(shapes[:4] if calm else shapes)()
