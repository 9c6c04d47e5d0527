"""numpy, imported when it is first used: most of the time that `import gough` would take is numpy's."""
from __future__ import annotations

import importlib
from typing import Any


class _Numpy:
    """The names of numpy, each kept after it was first looked up."""

    def __getattr__(self, name: str) -> Any:
        value = getattr(importlib.import_module("numpy"), name)
        setattr(self, name, value)
        return value


np = _Numpy()
ArrayLike = Any  #: what type hints say at run time; programs that check types read numpy's own
