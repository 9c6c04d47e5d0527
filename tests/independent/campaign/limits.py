"""How much of each limit of the legs a run uses, how often and when it exceeds it, and the sentences on that."""
import math

import facts as f
from facts import Q
from printed import Line

KINDS = {"short": ("leg_short", "length", "least length"), "long": ("leg_long", "length", "greatest length"),
         "speed": ("leg_speed", "speed", "greatest speed"), "force": ("leg_force", "force", "greatest force")}
TOGETHER = 1e-6  # legs within this share of the limit that ends a run are named beside the first


def given(meaning):
    """Limits of a study: kind to value."""
    keys, out = meaning.limits, {}
    low, high = keys.get("length", (0, math.inf))
    for kind, value in (("short", low), ("long", high), ("speed", keys.get("max_speed", math.inf)), ("force", keys.get("max_force", math.inf))):
        if 0 < value < math.inf:
            out[kind] = value
    return out


def share(kind, limit, value):
    """Share of the limit that a value uses; over 1 it is exceeded."""
    return limit / value if kind == "short" else abs(value) / limit


def margins(meaning, lengths, rates, forces):
    """How far each limit is exceeded, relative to it: (kind, leg from 0) to a number that is positive beyond."""
    values = {"short": lengths, "long": lengths, "speed": rates, "force": forces}
    return {(kind, k): 1 - values[kind][k] / limit if kind == "short" else abs(values[kind][k]) / limit - 1
            for kind, limit in given(meaning).items() for k in range(6)}


def ending(kind, limit, time, slack, beyond):
    """The end of a run at a limit, from the margins at that time."""
    legs = [k + 1 for k in range(6) if beyond[kind, k] > -TOGETHER]
    return {"status": KINDS[kind][0], "kind": kind, "time": time, "slack": slack, "leg": legs[0], "legs": legs, "limit": limit}


class Use:
    """One limit of one leg over a run."""

    def __init__(self, kind, leg, limit):
        self.kind, self.leg, self.limit = kind, leg, limit
        self.worst, self.count, self.enter, self.leave, self.worst_time = None, 0, None, None, None

    def take(self, value):
        if self.worst is None or share(self.kind, self.limit, value) > share(self.kind, self.limit, self.worst):
            self.worst = value

    def q(self, slack, time_slack, worst_slack):
        """Names to Q, None where there is no number."""
        dimension = KINDS[self.kind][1]
        used, time = share(self.kind, self.limit, self.worst), lambda t, s: None if t is None else Q(t, "time", s)
        of_share = used * slack / self.worst if self.kind == "short" else slack / self.limit
        return {"limit": Q(self.limit, dimension, 1e-12 * self.limit), "worst": Q(self.worst, dimension, slack),
                "share": Q(used, None, of_share + 1e-12), "count": Q(self.count, None, 0),
                "enter": time(self.enter, time_slack), "leave": time(self.leave, time_slack), "worst_time": time(self.worst_time, worst_slack)}


def uses(run):
    """All limits of all legs, kind by kind. run.crossings: intervals beyond; run.end; run.legs: peaks of the summary."""
    out = []
    for kind, limit in given(run.meaning).items():
        for k, leg in enumerate(run.legs):
            use = Use(kind, k + 1, limit)
            low, high = {"short": ("length_least",) * 2, "long": ("length_greatest",) * 2, "speed": ("speed",) * 2,
                         "force": ("force_greatest", "force_least")}[kind]
            use.take(leg[low].value), use.take(leg[high].value)
            mine = [c for c in run.crossings if (c["kind"], c["leg"]) == (kind, k + 1)]
            if mine:
                last = max(mine, key=lambda c: c["enter"])
                worst = max(mine, key=lambda c: share(kind, limit, c["worst"]))
                use.count, use.enter, use.leave, use.worst_time = len(mine), min(c["enter"] for c in mine), last["leave"], worst["worst_time"]
                use.take(abs(worst["worst"]) if kind == "speed" else worst["worst"])
            if run.simulated and run.end.get("kind") == kind and k + 1 in run.end["legs"]:
                if share(kind, limit, use.worst) < 1:
                    use.worst = limit
                use.count, use.enter, use.worst_time = 1, run.end["time"], run.end["time"]
            out.append((use, use.q(leg[low].slack, run.end["slack"], max(run.end["slack"], run.worst_time_slack))))
    return out


def json(run):
    out = []
    for use, q in uses(run):
        out.append({"leg": use.leg, "component": None, "least": False, "kind": KINDS[use.kind][0], **q, "count": use.count})
    return out


def lines(run, units):
    """The lines of the text and what their numbers should be."""
    all_uses, known, wanted = uses(run), [], {}
    if not all_uses:
        return [], {}
    known.append("limits nearest value, limit, share of the limit used" + ("; over 100 % means exceeded" if run.crossings else ""))
    for kind in given(run.meaning):
        mine = [(use, q) for use, q in all_uses if use.kind == kind]
        dimension, name = KINDS[kind][1:]

        def line(start, use, q, tail, kind=kind, dimension=dimension):
            key = f"limit_{kind}_{use.leg}_"
            known.append(f"{start} {{{key}worst .5 {dimension}}} of {{{key}limit .5 {dimension}}}, {{{key}share .4}} %, " + tail.replace("~", key))
            wanted.update({key + name: value for name, value in q.items()})
            wanted[key + "share"] = Q(100 * q["share"].value, None, 100 * q["share"].slack)

        for use, q in mine:
            if use.count:
                end = "{~enter time}, where the run ends" if run.simulated else "{~enter time} to the end"
                times = "{~count} times, " if use.count > 1 else ""
                line(f"leg {use.leg} {name}", use, q, times + "t = " + (end if use.leave is None else "{~enter} to {~leave time}"))
        if not any(use.count for use, _ in mine):
            use, q = max(mine, key=lambda pair: pair[1]["share"].value)
            line(name, use, q, f"leg {{nearest_{kind}}}")
            near = {other.leg for other, p in mine if abs(p["share"].value - q["share"].value) <= p["share"].slack + q["share"].slack}
            run.nearest[f"nearest_{kind}"] = near  # of legs as near as each other any may be named
    return [Line(x, units.name) for x in known], wanted


def sentence(end, units):
    """The end in words, its numbers in braces."""
    if end["status"] == "done":
        return ""
    legs, several = [str(k) for k in end["legs"]], len(end["legs"]) > 1
    name = "all six legs" if len(legs) == 6 else f"legs {', '.join(legs[:-1])} and {legs[-1]}" if several else f"leg {legs[0]}"
    verb = {"short": ("gets shorter than its", "get shorter than their"), "long": ("gets longer than its", "get longer than their")}
    verb = verb.get(end["kind"], ("exceeds its", "exceed their"))[several]
    _, dimension, limit = KINDS[end["kind"]]
    return f"{name} {verb} {limit} {{end_limit .9 {dimension}}} at t = {{end_time .9 time}}"


def sentence_facts(end):
    if end["status"] == "done":
        return {}
    return {"end_limit": Q(end["limit"], KINDS[end["kind"]][1], 1e-12 * end["limit"]), "end_time": Q(end["time"], "time", end["slack"])}
