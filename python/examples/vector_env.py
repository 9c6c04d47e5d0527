"""A thousand plants with loads of their own in a vector environment, held by a linear law.

    PYTHONPATH=build/python python3 python/examples/vector_env.py
"""
import numpy as np

import gough

machine = {
    "platform": {"base": {"radius": 1.5, "half_angle": 8}, "top": {"radius": 1.1, "half_angle": 8}, "height": 2, "legs": {"length": [1.5, 2.6]}},
    "load": {"mass": 1050, "inertia": [410, 520, 460]},
}


def start(rng, count):
    """Positions at random, and loads that differ by 20 %."""
    size = rng.uniform(0.8, 1.2, count)
    return {
        "position": np.array([0, 0, 2]) + rng.uniform(-0.05, 0.05, (count, 3)),
        "mass": 1050 * size,
        "center_of_mass": np.zeros(3),
        "inertia": size[:, None, None] * np.diag([410.0, 520, 460]),
    }


env = gough.VectorEnv(machine, 1000, step=1e-3, frame_skip=5, duration=2.0, force=1e4, start=start)
observation, _ = env.reset(seed=1)
total = np.zeros(env.num_envs)
for _ in range(400):
    error, rate = observation[:, 12:18], observation[:, 18:24]
    observation, reward, terminated, truncated, info = env.step(-4e5 * error - 1.5e4 * rate)
    total += reward
    if terminated.any():
        raise SystemExit("a plant has left its limits")
print(f"after 2 s the plants are within {1e3 * np.abs(observation[:, :3]).max():.2f} mm of home, where a load of its own pulls each")
print(f"{truncated.sum()} episodes are over; the mean reward is {total.mean():.3f}")
