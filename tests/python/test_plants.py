"""Plants under commands, poses from lengths, and the vector environment."""
import gough
import numpy as np
import pytest


@pytest.fixture
def limited(machine):
    machine["platform"]["legs"] = {"length": [1.7, 2.5]}
    return machine


def hold(plants):
    return plants.machine.inverse_dynamics([0, 0, plants.machine.height])


def test_poses_from_lengths(machine):
    m = gough.Machine(machine)
    rng = np.random.default_rng(5)
    position = np.array([0, 0, 2.0]) + rng.uniform(-0.1, 0.1, (30, 3))
    turn = gough.rotation(rng.uniform(-0.1, 0.1, (30, 3)))
    found = m.pose(m.lengths(position, turn))
    assert (found.reached == 1).all()
    assert (np.linalg.norm(found.position - position, axis=-1) <= found.position_error + 1e-15).all()
    assert np.abs(found.rotation - turn).max() < 1e-12
    record = m.pose(m.lengths(position, turn), follow=True)
    assert np.abs(record.position - position).max() < 1e-12
    one = m.pose(m.home_length)
    assert one.position.shape == (3,) and np.abs(one.position - [0, 0, 2]).max() < 1e-14
    assert 0 <= m.pose(m.home_length * 0.1).reached < 1
    assert np.isnan(m.pose(-m.home_length).reached)
    with pytest.raises(ValueError, match="lengths must have the shape"):
        m.pose([1, 2])
    with pytest.raises(ValueError, match="a record to follow"):
        m.pose(m.home_length, follow=True)


def test_plants_move_as_the_command_simulates(machine, tmp_path):
    """A command that is held is a run without control: the study's own drives at a constant force."""
    plants = gough.Plants(machine, 5, 0.01)
    force = hold(plants) * np.linspace(0.9, 1.1, 5)[:, None]
    plants.move(force, 50)
    for i in range(5):
        study = {name: part for name, part in machine.items() if name != "motion"}
        study["control"] = {"feedforward": "none"}
        study["disturbance"] = {"leg_force": force[i].tolist()}
        study["simulation"] = {"duration": 0.5, "output_step": 0.5, "method": "rk4", "step": 0.01}
        run = gough.simulate(study)
        assert run.status == 0
        assert np.abs(plants.length[i] - [run[f"l{leg}"][-1] for leg in range(1, 7)]).max() < 1e-13
        assert np.abs(plants.velocity[i] - [run[name][-1] for name in ("vx", "vy", "vz")]).max() < 1e-13


def test_views_are_of_one_state(machine):
    plants = gough.Plants(machine, 3, 0.01)
    position = plants.position
    plants.move(np.tile(hold(plants), (3, 1)) + [[50], [0], [-50]], 10)
    assert position is plants.position and np.shares_memory(position, plants.state)
    assert position[0, 2] > position[1, 2] > position[2, 2]
    assert np.abs(plants.length - plants.machine.lengths(plants.position.copy(), plants.rotation.copy())).max() < 1e-14
    assert np.abs(plants.rate - plants.machine.rates(*(a.copy() for a in (plants.position, plants.rotation, plants.velocity, plants.angular_velocity)))).max() < 1e-14


def test_a_plant_that_ends_stays_until_it_is_put(limited):
    plants = gough.Plants(limited, 9, 0.01, threads=2)
    command = np.tile(hold(plants), (9, 1))
    command[4] *= 0.2
    plants.move(command, 100)
    assert gough.ENDED[plants.ended[4]] == "limit" and not plants.ended[[0, 8]].any()
    assert plants.length[4].min() < 1.7
    before = plants.state[4].copy()
    plants.move(command, 10)
    assert np.array_equal(before, plants.state[4])
    plants.put(4)
    assert plants.ended[4] == 0 and plants.position[4, 2] == 2
    with pytest.raises(gough.StudyError, match="there is no plant 9"):
        plants.put(9)
    with pytest.raises(gough.StudyError, match="rk4 or dop853"):
        gough.Plants(limited, 2, 0.01, method="rattle4")
    with pytest.raises(ValueError, match="together"):
        plants.put(mass=3)


def test_loads_of_their_own(machine):
    plants = gough.Plants(machine, 12, 0.01)
    mass = np.linspace(500, 1600, 12)
    plants.put(mass=mass, center_of_mass=(0, 0, 0), inertia=mass[:, None, None] * np.eye(3))
    plants.move(np.zeros((12, 6)), 10)
    assert np.abs(plants.velocity[:, 2] + 0.1 * 9.80665).max() < 1e-13  # all fall alike
    plants.put()
    plants.move(np.tile(hold(plants), (12, 1)), 1)
    upwards = 1050 * 9.80665 / mass - 9.80665  # the first steps: forces are still vertical in sum
    assert np.abs(plants.velocity[:, 2] / 0.01 - upwards).max() < 1e-2
    plants.put(position=[0, 0, 2.0])
    still = plants.machine.forward_dynamics([0, 0, 2.0], force=hold(plants))
    assert np.abs(still.linear).max() < 1e-12


def test_one_call_of_step(machine):
    m = gough.Machine(machine)
    force = m.inverse_dynamics([0, 0, 2.0]) * 1.01
    moved = m.step(np.tile([0, 0, 2.0], (4, 3, 1)), force=force, step=0.01, steps=3)
    plants = gough.Plants(machine, 1, 0.01)
    plants.move(force[None], 3)
    assert moved.position.shape == (4, 3, 3) and moved.rotation.shape == (4, 3, 3, 3)
    assert np.array_equal(moved.position[2, 1], plants.position[0]) and not moved.ended.any()


# ---- the environment ----


def random_start(rng, count):
    return {"position": np.array([0, 0, 2]) + rng.uniform(-0.02, 0.02, (count, 3))}


def test_environment_is_reproducible_and_has_the_shapes(limited):
    def play(threads):
        env = gough.VectorEnv(limited, 20, duration=0.1, force=500, start=random_start, threads=threads)
        assert env.single_action_space.shape == (6,) and env.action_space.shape == (20, 6)
        assert env.observation_space.shape == (20, 24) and env.single_action_space.contains(np.zeros(6))
        rng = np.random.default_rng(0)
        seen = [env.reset(seed=3)[0]]
        for _ in range(25):
            observation, reward, terminated, truncated, info = env.step(rng.uniform(-500, 500, (20, 6)))
            assert reward.shape == terminated.shape == truncated.shape == info["ended"].shape == (20,)
            seen += [observation, reward, terminated, truncated]
        env.close()
        return seen

    for one, other in zip(play(1), play(3)):
        assert np.array_equal(one, other)


def test_episodes_end_and_begin_again_in_the_next_step(limited):
    env = gough.VectorEnv(limited, 4, step=1e-3, frame_skip=10, duration=0.05, start=random_start)
    first, _ = env.reset(seed=1)
    for k in range(5):
        observation, _, terminated, truncated, _ = env.step(np.zeros((4, 6)))
    assert truncated.all() and not terminated.any()
    again, reward, terminated, truncated, _ = env.step(np.full((4, 6), 1e6))
    assert not truncated.any() and not reward.any() and not terminated.any()
    assert np.abs(again[:, :3]).max() <= 0.02 and not np.array_equal(again, first)
    assert not again[:, 6:12].any()  # at rest where they begin


def test_a_limit_terminates(limited):
    env = gough.VectorEnv(limited, 3, duration=10)
    env.reset(seed=1)
    actions = np.zeros((3, 6))
    actions[1] = -1e4
    over = np.zeros(3, dtype=bool)
    for _ in range(40):
        _, _, terminated, truncated, info = env.step(actions)
        over |= terminated
        if terminated[1]:
            assert gough.ENDED[info["ended"][1]] == "limit"
            break
    assert over.tolist() == [False, True, False]


def test_disturbances_push_each_plant(limited):
    def push(rng, time):
        wrench = np.zeros((2, 6))
        wrench[1, 0] = 100
        return wrench

    env = gough.VectorEnv(limited, 2, step=1e-3, frame_skip=1, disturbance=push)
    env.reset(seed=1)
    observation, *_ = env.step(np.zeros((2, 6)))
    assert abs(observation[0, 6]) < 1e-12
    assert observation[1, 6] == pytest.approx(1e-3 * 100 / 1050, rel=1e-4)


def test_own_rewards_and_observations(limited):
    env = gough.VectorEnv(
        limited, 2, observe=lambda env: env.plants.length.copy(), reward=lambda env, actions: -np.abs(actions).sum(1)
    )
    observation, _ = env.reset()
    assert env.single_observation_space.shape == (6,) and np.allclose(observation, env.plants.machine.home_length)
    assert env.step(np.ones((2, 6)))[1].tolist() == [-6, -6]
