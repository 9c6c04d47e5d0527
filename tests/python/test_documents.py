"""Examples, notebooks and the guide run as they are written."""
import json
import re
import subprocess
import sys

import pytest
from conftest import SOURCE

SCRIPTS = sorted((SOURCE / "python" / "examples").glob("*.py"))
NOTEBOOKS = sorted((SOURCE / "python" / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_example(script, tmp_path):
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stdout and not done.stderr, done.stderr


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(notebook, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    names = {}
    for number, cell in enumerate(cells):
        if cell["cell_type"] != "code":
            continue
        assert cell["outputs"] == [] and cell["execution_count"] is None, f"cell {number} has stored outputs"
        exec(compile("".join(cell["source"]), f"{notebook.name}, cell {number}", "exec"), names)


def test_guide(tmp_path, monkeypatch):
    """The blocks of the guide, one after the other, in the source's folder, where its examples are."""
    monkeypatch.chdir(SOURCE)
    guide = (SOURCE / "docs" / "guide" / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", guide, re.M | re.S)
    names = {}
    for block in blocks:
        exec(compile(block, "python.md", "exec"), names)
    assert len(blocks) > 3
