"""Studies from files, dictionaries and texts."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, Union

from . import _gough
from ._errors import fail


def _plain(value: Any) -> Any:
    """numpy's arrays and numbers as lists and numbers."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a study has numbers, texts, lists and mappings, not {type(value).__name__}")


def _flow(value: Any) -> str:
    """A value on one line. JSON is YAML, but for numbers that are not finite, which no key takes."""
    return json.dumps(value, default=_plain, ensure_ascii=False)


def _block(mapping: Mapping, indent: str = "") -> str:
    lines = []
    for key, value in mapping.items():
        if not isinstance(key, str):
            raise TypeError(f"keys of a study are texts, not {type(key).__name__}")
        if isinstance(value, Mapping) and value:
            lines.append(f"{indent}{key}:\n{_block(value, indent + '  ')}")
        else:
            lines.append(f"{indent}{key}: {_flow(value)}\n")
    return "".join(lines)


def _setting(value: Any) -> str:
    return value if isinstance(value, str) else _flow(value)


class Study:
    """A study: a machine, its load, its program, its controller and how to run it.

    Parameters
    ----------
    source
        path of a study file; or a mapping with the keys of the guide to study files, as in
        ``{"platform": {...}, "load": {"mass": 100}}``; or another study, which is copied.
    set
        keys to override, as in ``{"control.stiffness": 50}``; elements of lists are numbered from 1.

    A study is read and checked at once: `StudyError` has every error with its place. Relative paths in a mapping start from the
    working folder. ``title``, ``duration`` [s] and ``base_units`` (the words of length, force, mass, angle and time) are those of
    the study; ``text`` is the study as YAML.
    """

    def __init__(self, source: "StudyLike", set: Mapping[str, Any] | None = None):
        self.path: str | None = None
        self.settings: dict[str, str] = {}
        if isinstance(source, Study):
            self.path, self.name, self.text = source.path, source.name, source.text
            self.settings.update(source.settings)
        elif isinstance(source, Mapping):
            self.name, self.text = "study", _block(source)
        else:
            self.path = self.name = os.fspath(source)
            try:
                with open(self.path, "rb") as file:
                    self._bytes = file.read()
            except OSError as error:
                fail(3, f"{self.path}: error: cannot open `{self.path}`: {error.strerror}")
            self.text = self._bytes.decode("utf-8", "replace")
        self.settings.update({key: _setting(value) for key, value in (set or {}).items()})
        self._read()

    @classmethod
    def from_text(cls, text: str, set: Mapping[str, Any] | None = None, name: str = "study") -> "Study":
        """A study from its text in YAML; relative paths in it start from the folder of `name`."""
        study = cls.__new__(cls)
        study.path, study.name, study.text = None, name, text
        study.settings = {key: _setting(value) for key, value in (set or {}).items()}
        study._read()
        return study

    def _read(self) -> None:
        text = getattr(self, "_bytes", None) or self.text.encode()
        try:
            self._handle = _gough.study_parse(self.name, text, list(self.settings.items()))
        except _gough.Failure as failure:
            fail(failure.args[0], failure.args[1])
        facts = _gough.study_facts(self._handle)
        self.title: str = facts["title"]
        self.dimensionless: bool = facts["dimensionless"]
        self.base_units: tuple[str, ...] = facts["base_units"]
        self.duration: float = facts["duration"]

    def with_settings(self, **settings: Any) -> "Study":
        """The study with other values; dots of keys are written as two underscores: ``control__stiffness=50``."""
        return Study(self, {key.replace("__", "."): value for key, value in settings.items()})

    def __repr__(self) -> str:
        return f"<gough.Study {self.title or self.name!r}>"


StudyLike = Union[str, "os.PathLike[str]", Mapping, Study]


def as_study(source: StudyLike, set: Mapping[str, Any] | None = None) -> Study:
    """`source` itself if it is a study that nothing is changed in."""
    return source if isinstance(source, Study) and not set else Study(source, set)
