"""A machine in many poses: identities, and an independent computation with numpy."""
import gough
import numpy as np
import pytest


@pytest.fixture
def poses():
    rng = np.random.default_rng(3)
    position = np.array([0, 0, 2.0]) + rng.uniform(-0.1, 0.1, (40, 25, 3))
    return position, gough.rotation(rng.uniform(-0.2, 0.2, (40, 25, 3))), rng


def test_lengths_are_distances_of_joints(machine, poses):
    position, rotation, _ = poses
    m = gough.Machine(machine)
    joints = position[..., None, :] + np.einsum("...ij,lj->...li", rotation, m.top)
    expected = np.linalg.norm(joints - m.base, axis=-1)
    assert np.abs(m.lengths(position, rotation) - expected).max() < 1e-14  # a few roundings of 2 m
    assert np.array_equal(m.lengths([0, 0, m.height]), m.home_length)


def test_jacobian_is_the_derivative_of_lengths(machine, poses):
    position, rotation, rng = poses
    m = gough.Machine(machine)
    v, w = rng.normal(size=(2, 40, 25, 3))
    jacobian = m.jacobian(position, rotation)
    assert jacobian.shape == (40, 25, 6, 6)
    rates = np.einsum("...ij,...j->...i", jacobian, np.concatenate([v, w], -1))
    assert np.abs(rates - m.rates(position, rotation, v, w)).max() < 1e-13
    h = 1e-6
    turned = rotation + h * np.cross(w[..., None, :], np.swapaxes(rotation, -1, -2)).swapaxes(-1, -2)
    back = rotation - h * np.cross(w[..., None, :], np.swapaxes(rotation, -1, -2)).swapaxes(-1, -2)
    slope = (m.lengths(position + h * v, turned) - m.lengths(position - h * v, back)) / (2 * h)
    assert np.abs(slope - rates).max() < 1e-8  # h² and 1e-16 / h


def test_forces_balance_weight_and_inertia(machine, poses):
    position, rotation, rng = poses
    m = gough.Machine(machine)
    a, alpha = rng.normal(size=(2, 40, 25, 3))
    w = rng.normal(size=(40, 25, 3))
    force = m.inverse_dynamics(position, rotation, None, w, a, alpha)
    wrench = np.einsum("...ji,...j->...i", m.jacobian(position, rotation), force)
    inertia = rotation @ np.diag([410.0, 520, 460]) @ np.swapaxes(rotation, -1, -2)
    spin = np.einsum("...ij,...j->...i", inertia, w)
    moment = np.einsum("...ij,...j->...i", inertia, alpha) + np.cross(w, spin)
    assert np.abs(wrench[..., :3] - 1050 * (a - m.gravity)).max() < 1e-7  # N of 1e4, times the condition
    assert np.abs(wrench[..., 3:] - moment).max() < 1e-7
    back = m.forward_dynamics(position, rotation, None, w, force)
    assert np.abs(back.linear - a).max() < 1e-11 and np.abs(back.angular - alpha).max() < 1e-11
    length, same = m.lengths_and_forces(position, rotation, None, w, a, alpha)
    assert np.array_equal(same, force) and np.array_equal(length, m.lengths(position, rotation))
    joints = m.joint_forces(position, rotation, None, w, a, alpha)
    assert np.abs(joints.top.sum(-2) - 1050 * (a - m.gravity)).max() < 1e-7
    assert np.abs(joints.leg - force).max() < 1e-9 and not joints.side.any()


def test_one_call_is_many_calls(machine, poses):
    position, rotation, _ = poses
    one, many = gough.Machine(machine, threads=1), gough.Machine(machine, threads=5)
    force = many.inverse_dynamics(position, rotation)
    assert np.array_equal(force, one.inverse_dynamics(position, rotation))
    assert np.array_equal(force[3, 7], one.inverse_dynamics(position[3, 7], rotation[3, 7]))
    assert np.array_equal(many.lengths(position), many.lengths(position, np.broadcast_to(np.eye(3), rotation.shape)))


def test_the_forces_of_a_program(machine):
    table = gough.forces(machine)
    pose = np.stack([table[c] for c in ("x", "y", "z")], -1)
    angles = np.radians(np.stack([table[c] for c in ("roll", "pitch", "yaw")], -1))
    m = gough.Machine(machine)
    assert np.abs(m.lengths(pose, gough.rotation(angles))[:, 0] - table["l1"]).max() < 1e-14
    assert np.abs(gough.angles(gough.rotation(angles, "xyz"), "xyz") - angles).max() < 1e-15


def test_a_singular_pose_has_no_forces(machine):
    machine["platform"]["top"]["half_angle"] = 8
    m = gough.Machine(machine)
    flat = np.array([[0, 0, 0.0], [0, 0, 2]])  # all joints in one plane
    force = m.inverse_dynamics(flat)
    assert np.isnan(force[0]).all() and np.isfinite(force[1]).all()
    condition, determinant = m.conditioning(flat)
    assert condition[0] > 1e8 and abs(determinant[0]) < 1e-12 and 1 <= condition[1] < 100


def test_wrong_arguments_are_named(machine):
    m = gough.Machine(machine)
    with pytest.raises(ValueError, match="position must have the shape"):
        m.lengths([0, 0])
    with pytest.raises(ValueError, match="rotation is given for the shape"):
        m.lengths(np.zeros((4, 3)), np.zeros((5, 3, 3)))
    with pytest.raises(ValueError, match="pose 2 of 4, counted from 0: the matrix is not a rotation"):
        m.lengths(np.zeros((4, 3)), np.stack([np.eye(3), np.eye(3), 2 * np.eye(3), np.zeros((3, 3))]))
    with pytest.raises(ValueError, match="order of angles"):
        gough.rotation([0, 0, 0], "zxz")
    with pytest.raises(ValueError, match="item 0 is not a rotation"):
        gough.angles(np.zeros((3, 3)))
