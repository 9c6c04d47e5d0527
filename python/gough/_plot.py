"""Figures by matplotlib, in the colours and with the panels of `gough plot`."""
from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import matplotlib.figure

    from ._results import Result

INK, PALE, GRID = "#333333", "#c9c9c9", "#e6e6e6"
_PALETTE = os.path.join(os.path.dirname(__file__), "palette.def")  # the table of colours of `gough plot`
_PLACES, _ANGLES = ("x", "y", "z"), ("roll", "pitch", "yaw")
_LEG_KINDS = {"lengths": ("l", "leg length"), "rates": ("dl", "leg rate"), "forces": ("f", "leg force"), "power": ("p", "leg power")}
KINDS = ("overview", "motion", *_LEG_KINDS, "deviation", "columns")


def palette(group: str) -> list[str]:
    """Colours of LEGS (1 … 6), AXES (x, y, z) or TABLES."""
    with open(_PALETTE, encoding="utf-8") as file:
        text = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.S)
    colour = dict(re.findall(r'COLOUR\((\w+), "(#\w+)"', text))
    names = re.search(rf"{group}\(([^)]*)\)", text)
    return [colour[name.strip()] for name in names[1].split(",")] if names else []


def _legs(result: "Result", kind: str) -> list[tuple[str, list[str], str]]:
    letter, what = _LEG_KINDS[kind]
    names = [f"{letter}{leg}" for leg in range(1, 7)]
    return [(what, names, result.units[names[0]])] if names[0] in result else []


def _components(result: "Result", prefix: str, what: str) -> list[tuple[str, list[str], str]]:
    panels = []
    for names, group in ((_PLACES, "position"), (_ANGLES, "angle")):
        there = [prefix + name for name in names if prefix + name in result]
        moving = [name for name in there if np.ptp(result[name]) > 0] or there
        if moving:
            panels.append((f"{what} {group}".strip(), moving, result.units[moving[0]]))
    return panels


def _panels(result: "Result", kind: str, columns: list[str] | None) -> list[tuple[str, list[str], str]]:
    if columns:
        kind = "columns"
    if kind == "columns":
        return [(name, [name], result.units[name]) for name in columns or [name for name in result if name != "t"][:6] if len(result[name])]
    if kind == "motion":
        return _components(result, "", "")
    if kind == "deviation":
        return _components(result, "e", "deviation of")
    if kind in _LEG_KINDS:
        return _legs(result, kind)
    if kind == "overview":
        last = _components(result, "e", "deviation of") if "ez" in result else _legs(result, "power")
        return _components(result, "", "") + _legs(result, "lengths") + _legs(result, "forces") + last
    raise ValueError(f"there is no kind of figure {kind!r}; the kinds are {', '.join(KINDS)}")


def draw(result: "Result", kind: str, columns: list[str] | None = None) -> "matplotlib.figure.Figure":
    """Draws a result over its first column."""
    axis = next(iter(result), None)
    panels = _panels(result, "columns" if axis != "t" and kind == "overview" else kind, columns)
    if axis is None or not panels:
        raise ValueError(f"this result of {result.verb} has no columns for the figure {kind!r}")
    from matplotlib.figure import Figure

    across = 1 if len(panels) < 3 else 2
    down = -(-len(panels) // across)
    figure = Figure(figsize=(5.2 * across, 2.6 * down + 0.4), layout="constrained")
    places = figure.subplots(down, across, sharex=True, squeeze=False).ravel()
    legs, axes = palette("LEGS"), palette("AXES")
    for place, (what, names, unit) in zip(places, panels):
        of_legs = len(names) == 6
        for number, name in enumerate(names):
            if f"e{name}" in result and name in _PLACES + _ANGLES:  # the program, which the deviation is from
                place.plot(result[axis], result[name] - result[f"e{name}"], color=PALE, linewidth=2.5)
            colour = axes[(_PLACES + _ANGLES).index(name.removeprefix("e")) % 3] if name.removeprefix("e") in _PLACES + _ANGLES else legs[number % 6]
            place.plot(result[axis], result[name], color=colour, linewidth=1.2, label=f"leg {number + 1}" if of_legs else name)
        place.set_ylabel(f"{what} [{unit}]" if unit not in ("", "1") else what, color=INK)
        place.grid(color=GRID)
        place.tick_params(colors=INK)
        for side in ("top", "right"):
            place.spines[side].set_visible(False)
        if len(names) > 1:
            place.legend(frameon=False, fontsize="small", ncols=min(3, len(names)))
    for place in places[len(panels) :]:
        place.set_visible(False)
    unit = result.units[axis]
    for place in places[max(0, len(panels) - across) : len(panels)]:
        place.set_xlabel(f"{axis} [{unit}]" if unit not in ("", "1") else axis, color=INK)
        place.tick_params(labelbottom=True)
    if result.title:
        figure.suptitle(result.title, color=INK)
    return figure
