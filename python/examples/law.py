"""A control law in Python at each sample of a sampled controller.

    PYTHONPATH=build/python python3 python/examples/law.py
"""
import gough

study = {
    "platform": {"base": {"radius": 1.5, "half_angle": 8}, "top": {"radius": 1.1, "half_angle": 8}, "height": 2},
    "load": {"mass": 1050, "inertia": [410, 520, 460]},
    "motion": {"heave": "0.05*sin(2*t)"},
    "control": {"feedforward": "program", "stiffness": 0, "sampling": {"period": 0.002}},
    "disturbance": {"force": [0, 0, -200]},
    "simulation": {"duration": 1, "output_step": 0.01},
}
sums = [0.0] * 6


def law(sample):
    """Stiffness, damping and an integral for each leg, beside the force of the program."""
    command = []
    for leg in range(6):
        error = sample["program_length"][leg] - sample["length"][leg]
        rate = sample["program_rate"][leg] - sample["rate"][leg]
        sums[leg] += 0.002 * error
        command.append(sample["program_force"][leg] + 4e5 * error + 1.5e4 * rate + 2e6 * sums[leg])
    return command


run = gough.simulate(study, law=law)
print(f"at t = 1 s the platform is {1e3 * run['ez'][-1]:.4f} mm from its program, after at most {1e3 * abs(run['ez']).max():.4f} mm")
