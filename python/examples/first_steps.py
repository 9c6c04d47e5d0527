"""A machine as a mapping: the forces of its legs, a heavier load, and a loop that holds it.

    PYTHONPATH=build/python python3 python/examples/first_steps.py
"""
import gough

machine = {
    "title": "A machine for first steps",
    "platform": {"base": {"radius": 1.5, "half_angle": 8}, "top": {"radius": 1.1, "half_angle": 8}, "height": 2},
    "load": {"mass": 1050, "inertia": [410, 520, 460]},
    "motion": {"heave": "0.1*sin(2*t)", "roll": "5*sin(3*t)"},
    "control": {"feedforward": "program", "stiffness": 4e5, "damping": 1.5e4},
    "disturbance": {"leg_force": "20*sin(5*t)"},
    "simulation": {"duration": 5, "output_step": 0.01},
}

forces = gough.forces(machine)
print(f"leg 1 pushes with {forces['f1'].min():.0f} to {forces['f1'].max():.0f} {forces.units['f1']}")

heavy = gough.forces(machine, set={"load.mass": 2100})
print(f"with twice the mass with {heavy['f1'].min():.0f} to {heavy['f1'].max():.0f} {heavy.units['f1']}")

motion = gough.simulate(machine)
print(f"it stays within {1000 * motion.summary['deviation']['position']:.3f} mm of its program")

loop = gough.stability(machine)
print("the loop is stable at home" if loop.summary["stable"] else "the loop is not stable at home")

try:
    gough.forces(machine, set={"load.mass": -1})
except gough.StudyError as error:
    print(f"{error.key}: {error.sentence}")
