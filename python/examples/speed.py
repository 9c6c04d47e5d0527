"""How fast the package is here, in processor time, which other programs disturb less than the clock.

    PYTHONPATH=build/python python3 python/examples/speed.py [--long]

Plants are compared with `gough sweep`, which runs as many machines of the same kind through as many steps in lanes.
"""
import resource
import subprocess
import sys
import time

import numpy as np

import gough

LONG = "--long" in sys.argv
MACHINE = {
    "platform": {"base": {"radius": 1.5, "half_angle": 8}, "top": {"radius": 1.1, "half_angle": 8}, "height": 2},
    "load": {"mass": 1050, "inertia": [410, 520, 460]},
}


def best(work, times):
    """Least processor time of several trials, in seconds."""
    found = np.inf
    for _ in range(times):
        begin = time.process_time()
        work()
        found = min(found, time.process_time() - begin)
    return found


def children():
    """Processor time of programs that have ended, in seconds."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def imports(module):
    """Processor time of a Python that imports a module, in seconds."""
    begin = children()
    subprocess.run([sys.executable, "-c", f"import {module}"], check=True)
    return children() - begin


machine = gough.Machine(MACHINE, threads=1)
numpy_alone = min(imports("numpy") for _ in range(3))
print(f"import gough: {min(imports('gough') for _ in range(3)):.2f} s, of which numpy {numpy_alone:.2f} s")

position, rotation = np.array([0, 0, 2.0]), np.eye(3)
count = 20000 if LONG else 2000
print(f"lengths of one pose: {best(lambda: [machine.lengths(position, rotation) for _ in range(count)], 5) / count * 1e6:.2f} us a call")

poses = 1_000_000 if LONG else 20_000
rng = np.random.default_rng(1)
many = position + rng.uniform(-0.05, 0.05, (poses, 3))
turns = gough.rotation(rng.uniform(-0.1, 0.1, (poses, 3)))
print(f"lengths of {poses} poses: {best(lambda: machine.lengths(many, turns), 3) / poses * 1e9:.0f} ns each")
print(f"lengths and forces of them: {best(lambda: machine.lengths_and_forces(many, turns), 3) / poses * 1e9:.0f} ns each")

number, steps = (10_000, 1000) if LONG else (500, 50)
plants = gough.Plants(MACHINE, number, 1e-3, threads=1)
command = np.tile(machine.inverse_dynamics(position), (number, 1))
for at_once in (1, 10):
    used = best(lambda: [plants.move(command, at_once) for _ in range(steps // at_once)], 2)
    print(f"{number} plants, {steps} steps, a command every {at_once}: {number * steps / used / 1e6:.2f} million steps a second of processor")
study = {
    **MACHINE,
    "simulation": {"duration": steps * 1e-3, "output_step": steps * 1e-3, "method": "rk4", "step": 1e-3},
    "sweep": {"keys": {"load.mass": {"uniform": [1000, 1100]}}, "runs": number},
}
begin = children()
gough.sweep(study, threads=1)
print(f"gough sweep, as many runs of as many steps: {number * steps / (children() - begin) / 1e6:.2f} million steps a second of processor")
