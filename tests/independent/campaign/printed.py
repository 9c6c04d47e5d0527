"""Reads what the command prints for people: sentences by their words, tables by their headings, numbers with their units.

A verb's text is a list of lines that are known. Each is a template: its words stand as they are printed, and in braces what is a
number, as in "condition   at most {condition .4}, at t = {condition_time time}" (a name, the dimension whose unit follows the
number, the significant digits). A line that no template knows, and a template that must come and does not, are failures.
"""
import re

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|-?inf|-?nan"
SI = {"length": "m", "speed": "m/s", "force": "N", "power": "W", "energy": "J", "time": "s", "mass": "kg", "inertia": "kg m^2",
      "stiffness": "N/m", "damping": "N s/m", "acceleration": "m/s^2", "volume": "m^3", "angle": "deg"}


class Unreadable(Exception):
    pass


def unit_of(dimension, units):
    """The word after a number, "" for none. units: si or dimensionless."""
    if dimension == "angle":
        return "deg"
    return SI[dimension] if dimension and units == "si" else ""


class Printed:
    """A number as it was printed: its value, and half of the unit of its last digit."""

    def __init__(self, text, digits=None):
        self.text, self.value = text, float(text)
        mantissa, _, exponent = text.lower().partition("e")
        shown = len(mantissa.partition(".")[2])
        if digits is not None:  # trailing zeros were left out: the digits say where the last one is
            size = abs(self.value)
            decade = 0 if size == 0 else int(f"{size:e}".partition("e")[2])
            places = digits - 1 - decade
            if shown - int(exponent or 0) > places and size:
                raise Unreadable(f"{text} has more than {digits} digits")
        else:
            places = shown - int(exponent or 0)
        self.half = 0.5000001 * 10.0 ** -places

    def __repr__(self):
        return self.text


class Line:
    """A template: words, and numbers in braces. `where` says when it must come: a function of the expected facts, or True."""

    def __init__(self, template, units, many=False):
        self.template, self.many, self.names, self.digits, pattern = template, many, [], [], ""
        for part in re.split(r"(\{[^}]*\})", template):
            if part.startswith("{"):
                name, *rest = part[1:-1].split()
                digits = next((int(x[1:]) for x in rest if x.startswith(".")), 6)
                dimension = next((x for x in rest if not x.startswith(".")), None)
                self.names.append(name)
                if dimension == "word":
                    self.digits.append(None)
                    pattern += r"(\S.*?)"
                    continue
                self.digits.append(digits)
                unit = unit_of(dimension, units)
                pattern += f"({NUMBER})" + (r"\s" + re.escape(unit) if unit else "")
            else:
                pattern += r"\s+".join(re.escape(word) for word in re.split(r"\s+", part))
        self.pattern = re.compile(r"\s*" + pattern.strip() + r"\s*$")

    def read(self, text):
        found = self.pattern.match(text)
        if not found:
            return None
        return [(name, word if digits is None else Printed(word, digits))
                for name, word, digits in zip(self.names, found.groups(), self.digits)]


class Table:
    """A table over the legs. columns: (group, head, dimension, name); a column without group shows its unit in its place.

    Headings are checked word by word; each row gives name[leg] for legs 1 … 6 and, if there, `all`."""

    def __init__(self, columns, units, with_all):
        self.columns, self.with_all, self.units = columns, with_all, units
        upper, lower = [], ["leg"]
        for k, (group, head, dimension, _) in enumerate(columns):
            unit = unit_of(dimension, units)
            shown = f"[{unit}]" if unit else ""
            if not group:
                if shown and head.endswith("|"):  # a name over its unit
                    upper.append(head[:-1])
                    lower.append(shown)
                else:
                    lower.append(f"{head.rstrip('|')} {shown}" if not head.endswith("|") and shown else head.rstrip("|"))
                continue
            if k == 0 or columns[k - 1][0] != group:
                upper.append(group.replace("[]", shown).strip())
            lower.append(head)
        self.upper, self.lower = " ".join(upper).split(), " ".join(lower).split()
        self.rows = [str(leg) for leg in range(1, 7)] + (["all"] if with_all else [])

    def starts(self, lines, at):
        return at + 1 < len(lines) and lines[at].split() == self.upper and lines[at + 1].split() == self.lower

    def read(self, lines, at):
        out = []
        for k, row in enumerate(self.rows):
            words = lines[at + 2 + k].split() if at + 2 + k < len(lines) else []
            if len(words) != 1 + len(self.columns) or words[0] != row:
                raise Unreadable(f"row {row} of a table is {' '.join(words)!r}")
            for (_, _, _, name), word in zip(self.columns, words[1:]):
                out.append((f"{name}[{row}]", None if word == "-" else Printed(word)))
        return out, at + 2 + len(self.rows)


def read(text, known):
    """Pairs (name, Printed) of a text whose lines `known` lists in any order. Each must come once; of a line
    that is `many` there may be none or several, each a pair ("records", its numbers by name)."""
    lines, at, out, seen = text.split("\n"), 0, [], set()
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        for item in known:
            if isinstance(item, Table):
                if item.starts(lines, at):
                    found, at = item.read(lines, at)
                    break
            else:
                found = item.read(lines[at])
                if found is not None:
                    at += 1
                    break
        else:
            raise Unreadable(f"no one knows the line {lines[at]!r}")
        if id(item) in seen and not getattr(item, "many", False):
            raise Unreadable(f"the line {item.template!r} comes twice")
        seen.add(id(item))
        out += [("records", dict(found))] if getattr(item, "many", False) else found
    for item in known:
        if id(item) not in seen and not getattr(item, "many", False):
            raise Unreadable(f"missing: {getattr(item, 'template', None) or 'the table ' + ' '.join(item.upper + item.lower)!r}\n{text}")
    return out
