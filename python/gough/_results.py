"""Results: columns as numpy arrays with units, and the numbers that the command prints."""
from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _command, _gough
from ._errors import fail
from ._study import Study

if TYPE_CHECKING:
    import matplotlib.figure
    import numpy as np
    import pandas
    import xarray
else:
    from ._numpy import np


class End(NamedTuple):
    """How a run ended."""

    cause: str  #: ``done``, or why it ended early: ``leg_short``, ``singular`` …
    time: float  #: time of the end, in the unit of column ``t``
    leg: int | None  #: 1 … 6 if a leg is the cause
    component: int | None  #: 1 … 6 for surge … yaw if a limit of the platform is the cause
    limit: float | None  #: the limit, in the units of the table
    message: str  #: one sentence; empty if the cause is ``done``


class Result(Mapping[str, "np.ndarray"]):
    """What a verb returns.

    As a mapping it has the columns of its table: ``result["f1"]`` is an array of float64, read only, one number for each row.
    ``units["f1"]`` is its unit, ``long_names["f1"]`` says what it is. ``summary`` is what the command prints with ``--json``, a
    dictionary with the keys of the guide to JSON. ``status`` is 0, or 1 if a limit is exceeded or a run ended early. ``remarks``
    are the sentences that the command prints beside its results.
    """

    def __init__(
        self,
        verb: str,
        study: Study | None = None,
        columns: list | None = None,
        summary: dict | Callable[[], dict] | None = None,
        status: int = 0,
        remarks: list[str] | None = None,
        end: End | None = None,
        table: Any = None,
    ):
        self.verb, self.study, self.status, self.end = verb, study, status, end
        self.remarks: list[str] = remarks or []
        self.units: dict[str, str] = {}
        self.long_names: dict[str, str] = {}
        self._columns: dict[str, np.ndarray] = {}
        self._summary, self._table = summary, table
        for name, what, unit, numbers in columns or []:
            self._columns[name] = np.asarray(numbers)
            self.units[name], self.long_names[name] = unit, what

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            known = ", ".join(self._columns) or "no columns"
            raise KeyError(f"{name!r} is no column of this result, which has {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def summary(self) -> dict:
        """The dictionary that the command prints with ``--json``; of a run in this process it is made when it is first asked for."""
        if callable(self._summary):
            self._summary = self._summary()
        if self._summary is None:
            raise AttributeError(f"{self.verb} has no summary here: a run with a law in Python is not known to the command")
        return self._summary

    @property
    def title(self) -> str:
        """Title of the study."""
        return self.study.title if self.study else ""

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the table to a file, .h5 or .csv by its ending, with the same bytes as the command."""
        if self._table is None:
            raise ValueError(f"this result of {self.verb} has no table; give the function `output`")
        try:
            _gough.result_write(self._table, os.fspath(path))
        except _gough.Failure as failure:
            fail(*failure.args)

    def to_pandas(self) -> "pandas.DataFrame":
        """The table as a DataFrame, indexed by its first column; ``attrs["units"]`` has the units."""
        import pandas

        frame = pandas.DataFrame(dict(self._columns))
        if len(self):
            frame = frame.set_index(next(iter(self)))
        frame.attrs.update(title=self.title, units=dict(self.units))
        return frame

    def to_xarray(self) -> "xarray.Dataset":
        """The table as a Dataset over its first column, with the attributes ``units`` and ``long_name`` of each variable."""
        import xarray

        names = list(self)
        axis = names[0] if names else "row"

        def variable(name: str):
            return (axis, self[name], {"units": self.units[name], "long_name": self.long_names[name] or name})

        return xarray.Dataset(
            {name: variable(name) for name in names[1:]},
            coords={axis: variable(axis)} if names else None,
            attrs={"title": self.title, "verb": self.verb},
        )

    def plot(self, kind: str = "overview", columns: list[str] | None = None) -> "matplotlib.figure.Figure":
        """Draws the result with matplotlib: ``overview``, ``motion``, ``lengths``, ``forces``, ``rates``, ``power``, ``deviation``,
        or the columns that are named. Returns the figure."""
        from ._plot import draw

        return draw(self, kind, columns)

    def _repr_html_(self) -> str:
        if self.verb in ("forces", "simulate") and self.study is not None and callable(self._summary):
            from ._verbs import report

            try:
                return report(self.study)._repr_html_()
            except (OSError, ValueError):
                pass  # without the page, the numbers
        text = json.dumps(self._summary if isinstance(self._summary, dict) else {"rows": self._rows()}, indent=2, ensure_ascii=False)
        return f"<details open><summary>{html.escape(self.verb)}: {html.escape(self.title)}</summary><pre>{html.escape(text)}</pre></details>"

    def _rows(self) -> int:
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def __repr__(self) -> str:
        end = f", ended early: {self.end.message}" if self.end and self.end.cause != "done" else ""
        return f"<gough.Result of {self.verb}: {len(self)} columns, {self._rows()} rows{end}>"


class Page:
    """The page of a study: one HTML text that shows the machine in motion. A notebook shows it; `save` writes it to a file."""

    def __init__(self, text: str, status: int, remarks: list[str]):
        self.html, self.status, self.remarks = text, status, remarks

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file."""
        try:
            with open(path, "w", encoding="utf-8") as file:
                file.write(self.html)
        except OSError as error:
            fail(3, f"{os.fspath(path)}: error: cannot write `{os.fspath(path)}`: {error.strerror}")

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:640px;border:0"></iframe>'

    def __repr__(self) -> str:
        return f"<gough.Page of {len(self.html)} characters>"


def from_table(verb: str, study: Study | None, path: str | None, status: int, summary: dict | None, remarks: list[str]) -> Result:
    """A result of the command, with the table that it has written, if any."""
    columns = _command.read_table(path)[0] if path and os.path.exists(path) else None
    return Result(verb, study, columns, summary, status, remarks)
