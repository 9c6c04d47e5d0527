"""Many plants that commands move, and the vector environment of learning libraries over them."""
from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _gough
from ._errors import fail
from ._machine import Machine
from ._machine import angles as angles_of
from ._study import StudyLike

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike
else:
    from ._numpy import ArrayLike, np

#: why a plant does not move any more, by the numbers of `Plants.ended`
ENDED = ("moves", "limit", "singular", "not_finite")


class Plants:
    """N plants side by side, moved by fixed steps under commands of their drives.

    Parameters
    ----------
    study
        path, mapping or `Study`: its machine, drives and limits. Its program, controller and disturbances are not used
    count
        number of plants, N
    step
        fixed step [s]
    method
        ``"rk4"`` or ``"dop853"``
    threads
        how many threads a call uses; 0: one for each processor

    All numbers are in SI units and radians. After each call ``position`` (N, 3), ``rotation`` (N, 3, 3), ``velocity`` (N, 3) and
    ``angular_velocity`` (N, 3) are views of ``state`` (N, 18), which is written in place, as are ``length`` and ``rate`` (N, 6);
    copy what you keep. ``ended`` (N) is 0 while a plant moves, else the place of the reason in `gough.ENDED`: limits are compared
    at the ends of steps, and a plant that has ended stays where it is until it is put elsewhere.
    """

    def __init__(
        self, study: StudyLike, count: int, step: float, *, method: str = "rk4", threads: int = 0, set: Mapping[str, Any] | None = None
    ):
        self.machine = Machine(study, threads=threads, set=set)
        self.count, self.step, self.threads = count, step, threads
        try:
            self._fleet = _gough.fleet_new(self.machine._handle, count, step, method)
        except _gough.Failure as failure:
            fail(*failure.args)
        self.state = np.zeros((count, 18))
        self.position = self.state[:, :3]
        self.rotation = self.state[:, 3:12].reshape(count, 3, 3)
        self.velocity = self.state[:, 12:15]
        self.angular_velocity = self.state[:, 15:]
        self.position[:] = 0, 0, self.machine.height
        self.rotation[:] = np.eye(3)
        self.length = np.tile(self.machine.home_length, (count, 1))
        self.rate = np.zeros((count, 6))
        self.ended = np.zeros(count, dtype=np.uint8)

    def put(
        self,
        plants: ArrayLike | None = None,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike = (0, 0, 0),
        angular_velocity: ArrayLike = (0, 0, 0),
        mass: ArrayLike | None = None,
        center_of_mass: ArrayLike | None = None,
        inertia: ArrayLike | None = None,
    ) -> None:
        """Puts plants into states, in which they move again, and gives them loads.

        Parameters
        ----------
        plants
            their numbers, from 0; all if left out
        position, rotation, velocity, angular_velocity
            for each of them or one for all; home at rest if left out
        mass, center_of_mass, inertia
            a load for each of them [kg], (3) [m] in the top frame, (3, 3) [kg m²] about the centre of mass; all three together, or none:
            they keep the load that they have
        """
        numbers = np.arange(self.count) if plants is None else np.atleast_1d(np.asarray(plants, dtype=np.int64))
        many = len(numbers)
        if position is None:
            position = (0, 0, self.machine.height)
        states = np.empty((many, 18))
        states[:, :3], states[:, 12:15], states[:, 15:] = position, velocity, angular_velocity
        states[:, 3:12] = np.broadcast_to(np.eye(3) if rotation is None else rotation, (many, 3, 3)).reshape(many, 9)
        loads = None
        given = [value is not None for value in (mass, center_of_mass, inertia)]
        if any(given):
            if not all(given):
                raise ValueError("a load is mass, center_of_mass and inertia together")
            loads = np.empty((many, 13))
            loads[:, 0], loads[:, 1:4] = mass, center_of_mass
            loads[:, 4:] = np.broadcast_to(inertia, (many, 3, 3)).reshape(many, 9)
        if many == 0:
            return
        try:
            _gough.fleet_put(self._fleet, numbers.tolist(), states, loads)
        except _gough.Failure as failure:
            fail(*failure.args)
        self.state[numbers] = states
        self.length[numbers] = self.machine.lengths(states[:, :3].copy(), states[:, 3:12].reshape(many, 3, 3).copy())
        self.rate[numbers] = self.machine.rates(
            states[:, :3].copy(), states[:, 3:12].reshape(many, 3, 3).copy(), states[:, 12:15].copy(), states[:, 15:].copy()
        )
        self.ended[numbers] = 0

    def move(self, command: np.ndarray, steps: int = 1, wrench: np.ndarray | None = None) -> None:
        """Moves all plants by `steps` steps.

        `command` (N, 6) [N] is the force that each drive is to have, held meanwhile; `wrench` (N, 6) a force on the load at its
        centre of mass [N] and a moment [N m], base axes. Arrays of float64 in C order are used without a copy.
        """
        command = np.require(command, np.float64, ["C", "W"])
        wrench = None if wrench is None else np.require(wrench, np.float64, ["C", "W"])
        try:
            _gough.fleet_move(self._fleet, steps, self.threads, command, wrench, self.state, self.length, self.rate, self.ended)
        except _gough.Failure as failure:
            fail(*failure.args)


@dataclass
class Box:
    """A range of arrays, with the members that learning libraries read: low, high, shape, dtype."""

    low: np.ndarray
    high: np.ndarray

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the arrays."""
        return self.low.shape

    @property
    def dtype(self) -> np.dtype:
        """Type of their numbers."""
        return self.low.dtype

    def sample(self, rng: np.random.Generator | None = None) -> np.ndarray:
        """Numbers at random between the bounds; where there is no bound, from a normal distribution."""
        rng = rng or np.random.default_rng()
        bounded = np.isfinite(self.low) & np.isfinite(self.high)
        inside = rng.uniform(np.where(bounded, self.low, 0), np.where(bounded, self.high, 1))
        return np.where(bounded, inside, rng.normal(size=self.shape))

    def contains(self, value: ArrayLike) -> bool:
        """Whether an array lies between the bounds."""
        array = np.asarray(value)
        return bool(array.shape == self.shape and (array >= self.low).all() and (array <= self.high).all())


Start = Callable[["np.random.Generator", int], Mapping[str, "ArrayLike"]]


class VectorEnv:
    """N plants as the vector environment of gymnasium, without depending on it.

    Parameters
    ----------
    study, num_envs
        as in `Plants`
    step, frame_skip
        fixed step of the plants [s], and how many of them a command is held
    duration
        length of an episode [s], after which it is truncated
    force
        greatest magnitude of an action [N]: one number
    hold
        add the forces that hold the study's machine at home to each action
    start
        called as ``start(rng, n)`` when n plants are reset: arguments of `Plants.put`, such as positions at random, or loads of their
        own. Left out, they begin at home at rest
    disturbance
        called as ``disturbance(rng, time)`` before each step with the times of the plants (N) [s]: wrenches (N, 6) as in `Plants.move`
    observe, reward
        called as ``observe(env)`` and ``reward(env, actions)`` after each step. Left out, an observation is the 24 numbers position
        from home [m], roll, pitch and yaw [rad], velocity [m/s], angular velocity [rad/s], leg lengths from home [m] and their rates
        [m/s]; a reward is the negative sum of the squares of the first six
    method, threads, set
        as in `Plants`

    A plant that ends (``terminations``) or whose episode is over (``truncations``) is reset by the next call of `step`, in which its
    action is ignored and its reward is 0 (``autoreset_mode`` is ``"NextStep"``). The same seed gives the same numbers, for any
    number of threads.
    """

    metadata = {"autoreset_mode": "NextStep", "render_modes": []}

    def __init__(
        self,
        study: StudyLike,
        num_envs: int,
        *,
        step: float = 1e-3,
        frame_skip: int = 10,
        duration: float = 10.0,
        force: float = math.inf,
        hold: bool = True,
        start: Start | None = None,
        disturbance: Callable[[np.random.Generator, np.ndarray], np.ndarray] | None = None,
        observe: Callable[["VectorEnv"], np.ndarray] | None = None,
        reward: Callable[["VectorEnv", np.ndarray], np.ndarray] | None = None,
        method: str = "rk4",
        threads: int = 0,
        set: Mapping[str, Any] | None = None,
    ):
        self.plants = Plants(study, num_envs, step, method=method, threads=threads, set=set)
        self.num_envs, self.frame_skip, self.duration = num_envs, frame_skip, duration
        machine = self.plants.machine
        self.home = np.array([0, 0, machine.height])
        self.hold = machine.inverse_dynamics(self.home) if hold else np.zeros(6)
        self.time = np.zeros(num_envs)
        self.rng = np.random.default_rng()
        self._start, self._disturbance = start, disturbance
        self._observe, self._reward = observe or _observation, reward or _closeness
        self._over = np.ones(num_envs, dtype=bool)
        self.single_action_space = Box(np.full(6, -force), np.full(6, force))
        self.action_space = _repeated(self.single_action_space, num_envs)
        shape = np.asarray(self._observe(self)).shape[1:]
        self.single_observation_space = Box(np.full(shape, -np.inf), np.full(shape, np.inf))
        self.observation_space = _repeated(self.single_observation_space, num_envs)

    def _begin(self, numbers: np.ndarray) -> None:
        if len(numbers) == 0:
            return
        given = self._start(self.rng, len(numbers)) if self._start else {}
        self.plants.put(numbers, **given)
        self.time[numbers] = 0
        self._over[numbers] = False

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[np.ndarray, dict]:
        """Resets all plants; ``options={"reset_mask": mask}`` those of a mask only. Returns observations (N, …) and an empty dictionary."""
        if seed is not None:
            self.rng = np.random.default_rng(seed)
        mask = (options or {}).get("reset_mask")
        self._begin(np.arange(self.num_envs) if mask is None else np.flatnonzero(mask))
        return self._observe(self), {}

    def step(self, actions: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict]:
        """Applies actions (N, 6) [N], clipped to the action space.

        Returns observations (N, …), rewards (N), terminations (N), truncations (N) and a dictionary with ``ended``, the reasons of
        `gough.ENDED` as numbers (N).
        """
        again = self._over.copy()
        self._begin(np.flatnonzero(again))
        space = self.single_action_space
        command = np.clip(np.asarray(actions, dtype=np.float64), space.low, space.high) + self.hold
        if again.any():
            kept = {name: getattr(self.plants, name)[again].copy() for name in ("state", "length", "rate")}
            command[again] = self.hold
        wrench = self._disturbance(self.rng, self.time) if self._disturbance else None
        self.plants.move(command, self.frame_skip, wrench)
        self.time += self.plants.step * self.frame_skip
        if again.any():
            self._put_back(again, kept)
        terminations = self.plants.ended != 0
        truncations = (self.time >= self.duration * (1 - 1e-12)) & ~terminations
        self._over = terminations | truncations
        rewards = np.where(again, 0.0, self._reward(self, actions))
        return self._observe(self), rewards, terminations, truncations, {"ended": self.plants.ended.copy()}

    def _put_back(self, again: np.ndarray, kept: dict[str, np.ndarray]) -> None:
        """Plants that were reset in this call show where they begin."""
        numbers = np.flatnonzero(again)
        states = kept["state"]
        self.plants.put(
            numbers,
            position=states[:, :3],
            rotation=states[:, 3:12].reshape(-1, 3, 3),
            velocity=states[:, 12:15],
            angular_velocity=states[:, 15:],
        )
        self.time[again] = 0

    def close(self) -> None:
        """Frees the plants; the environment must not be used afterwards."""
        self.plants._fleet = None

    def __repr__(self) -> str:
        return f"<gough.VectorEnv of {self.num_envs} plants, {self.plants.step * self.frame_skip:g} s a step>"


def _repeated(space: Box, count: int) -> Box:
    return Box(np.tile(space.low, (count,) + (1,) * space.low.ndim), np.tile(space.high, (count,) + (1,) * space.high.ndim))


def _observation(env: VectorEnv) -> np.ndarray:
    plants = env.plants
    return np.concatenate(
        [
            plants.position - env.home,
            angles_of(plants.rotation),
            plants.velocity,
            plants.angular_velocity,
            plants.length - plants.machine.home_length,
            plants.rate,
        ],
        axis=1,
    )


def _closeness(env: VectorEnv, actions: ArrayLike) -> np.ndarray:
    plants = env.plants
    return -(((plants.position - env.home) ** 2).sum(1) + (angles_of(plants.rotation) ** 2).sum(1))


