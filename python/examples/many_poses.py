"""Leg forces over a grid of poses in one call: where in its workspace a machine pushes hardest.

    PYTHONPATH=build/python python3 python/examples/many_poses.py
"""
import numpy as np

import gough

machine = gough.Machine(
    {
        "platform": {"base": {"radius": 1.5, "half_angle": 8}, "top": {"radius": 1.1, "half_angle": 8}, "height": 2},
        "load": {"mass": 1050, "inertia": [410, 520, 460]},
    }
)
x, z, pitch = np.meshgrid(np.linspace(-0.3, 0.3, 41), 2 + np.linspace(-0.2, 0.2, 41), np.radians(np.linspace(-15, 15, 31)), indexing="ij")
position = np.stack([x, np.zeros_like(x), z], axis=-1)
rotation = gough.rotation(np.stack([np.zeros_like(x), pitch, np.zeros_like(x)], axis=-1))

length, force = machine.lengths_and_forces(position, rotation)
worst = np.unravel_index(np.abs(force).max(-1).argmax(), x.shape)
print(f"{x.size} poses: legs from {length.min():.3f} to {length.max():.3f} m")
print(f"the greatest force is {np.abs(force[worst]).max():.0f} N at x = {x[worst]:.3f} m, z = {z[worst]:.3f} m, pitch = {np.degrees(pitch[worst]):.1f} deg")

pose = machine.pose(length[0, 0], position[0, 0], rotation[0, 0], follow=True)
error = np.abs(pose.position - position[0, 0]).max()
print(f"the poses of {len(pose.reached)} lengths, followed as a record, are certain; the greatest error is {error:.0e} m")
assert (pose.reached == 1).all()
