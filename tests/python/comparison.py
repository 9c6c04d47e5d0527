"""Comparison of results with what the command prints and writes."""
import csv
import json

import numpy as np


WORDS = {"end_cause", "mode"}  # columns of words in CSV, of numbers in HDF5


def columns_of(path):
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return header, list(zip(*rows))


def same(result, status, text, path=None):
    """A result has the status, the JSON and the bits of the table that the command gives."""
    assert result.status == status and result.summary == json.loads(text)
    if path is None:
        assert len(result) == 0
        return
    header, columns = columns_of(path)
    assert list(result) == header
    for name, texts in zip(header, columns):
        if name in WORDS:
            continue
        expected = np.array([float(number or "nan") for number in texts])  # a cell without a number is empty
        given = np.isfinite(expected)
        assert np.array_equal(np.isnan(expected), np.isnan(result[name])), name
        assert np.array_equal(result[name][given].view(np.uint64), expected[given].view(np.uint64)), name
