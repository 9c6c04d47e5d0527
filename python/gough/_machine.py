"""One machine in many poses at once."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from . import _gough
from ._study import StudyLike, as_study

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike
else:
    from ._numpy import ArrayLike, np

_KINEMATICS, _JACOBIAN, _CONDITIONING, _INVERSE, _FORWARD, _JOINTS = range(6)
_ORDERS = ("zyx", "xyz")
_TAILS = ((3,), (3, 3), (3,), (3,), (3,), (3,), (6,), (6,))
_NAMES = ("position", "rotation", "velocity", "angular_velocity", "acceleration", "angular_acceleration", "force", "wrench")


def rotation(angles: ArrayLike, order: str = "zyx") -> np.ndarray:
    """Rotation matrices of roll, pitch and yaw.

    Parameters
    ----------
    angles
        shape (..., 3), in radians
    order
        ``"zyx"``: R = Rz(yaw) Ry(pitch) Rx(roll); ``"xyz"``: R = Rx(roll) Ry(pitch) Rz(yaw)

    Returns shape (..., 3, 3); columns are the axes of the top frame in the base frame.
    """
    given = np.ascontiguousarray(angles, dtype=np.float64)
    if given.shape[-1:] != (3,):
        raise ValueError(f"angles must have the shape (..., 3), not {given.shape}")
    matrix = np.empty(given.shape + (3,))
    _gough.rotations(_order(order), given.size // 3, given, matrix)
    return matrix


def angles(rotation: ArrayLike, order: str = "zyx") -> np.ndarray:
    """Roll, pitch and yaw in radians, shape (..., 3), of rotations of shape (..., 3, 3); the inverse of `rotation`."""
    given = np.ascontiguousarray(rotation, dtype=np.float64)
    if given.shape[-2:] != (3, 3):
        raise ValueError(f"rotations must have the shape (..., 3, 3), not {given.shape}")
    three = np.empty(given.shape[:-1])
    refused = _gough.angles_of(_order(order), given.size // 9, given, three)
    if refused is not None:
        raise ValueError(f"the matrix of item {refused} is not a rotation")
    return three


def _order(order: str) -> int:
    if order not in _ORDERS:
        raise ValueError(f"the order of angles is 'zyx' or 'xyz', not {order!r}")
    return _ORDERS.index(order)


class Conditioning(NamedTuple):
    """How close poses are to singular ones; neither number has a unit."""

    condition: np.ndarray  #: condition number of the Jacobian: 1 is best, infinite in a singular pose
    determinant: np.ndarray  #: its determinant; the sign changes across a singular surface


class Accelerations(NamedTuple):
    """Accelerations of the top, base axes."""

    linear: np.ndarray  #: of the origin of the top frame, shape (..., 3), m/s²
    angular: np.ndarray  #: shape (..., 3), rad/s²


class JointForces(NamedTuple):
    """Forces at the joints of the legs, N."""

    leg: np.ndarray  #: in each leg, between cylinder and piston, shape (..., 6); a push is positive
    top: np.ndarray  #: of each leg on the top, base axes, shape (..., 6, 3)
    base: np.ndarray  #: of the base on each leg, base axes, shape (..., 6, 3)
    side: np.ndarray  #: across each leg at the centre of mass of the piston, shape (..., 6)


class Followed(NamedTuple):
    """Poses that were followed to given lengths, with what is certain about them."""

    position: np.ndarray  #: of the origin of the top frame, shape (..., 3), m
    rotation: np.ndarray  #: shape (..., 3, 3)
    reached: np.ndarray  #: part of the way that is certain, shape (...): 1 is all of it; NaN if lengths are not above 0
    margin: np.ndarray  #: 1 for no change, 0 for the greatest that one step can certify, shape (...)
    position_error: np.ndarray  #: bound of the error of the position, shape (...), m
    angle_error: np.ndarray  #: bound of the error of the rotation, shape (...), rad


class Moved(NamedTuple):
    """States after steps; shapes are those of the arguments of `Machine.step`."""

    position: np.ndarray  #: m
    rotation: np.ndarray  #: columns are the axes of the top frame
    velocity: np.ndarray  #: m/s
    angular_velocity: np.ndarray  #: rad/s
    ended: np.ndarray  #: 0, or the place of the reason in `gough.ENDED`: the plant then stays where it ended


class Machine:
    """A machine, for many poses in one call.

    Parameters
    ----------
    study
        path, mapping or `Study`; its machine is used. Its external loads are not: pass them as `wrench`
    threads
        how many threads a call may use; 0: one for each processor
    set
        keys of the study to override

    All numbers are in SI units and radians, whatever units the study has (of a dimensionless study, without units). Arrays have any
    leading shape (...), the same in all arguments of a call; an argument without it is the same for all poses. Arrays of float64
    in C order are used as they are, without a copy. A pose is ``position``, the origin of the top frame in the base frame [m],
    and ``rotation``, whose columns are the axes of the top frame; left out, the top is parallel to the base. `rotation()`
    makes rotations of angles. The interpreter's lock is released in calls for 512 poses and more.

    A matrix that is not a rotation raises ValueError. In a pose that has no answer, such as a singular one, the answer is NaN.
    """

    def __init__(self, study: StudyLike, *, threads: int = 0, set: dict[str, Any] | None = None):
        self.study = as_study(study, set)
        self._handle = self.study._handle
        self._unit = np.eye(3)
        self.threads: int = _gough.threads(threads)
        facts = _gough.machine_facts(self._handle)
        self.height: float = facts["height"]
        self.base_radius: float = facts["base_radius"]
        self.mass: float = facts["mass"]
        self.base = np.asarray(facts["base"]).reshape(6, 3)
        self.top = np.asarray(facts["top"]).reshape(6, 3)
        self.home_length = np.asarray(facts["home_length"])
        self.gravity = np.asarray(facts["gravity"])
        self.order: str = _ORDERS[facts["order"]]

    # ---- calls ----

    def _each(self, function: int, given: tuple, tails: tuple) -> tuple:
        """Calls the library for all items; `given` are eight arrays or None, `tails` the shapes of an item of each output."""
        arrays: list = [None] * 8
        lead: tuple = ()
        for i, value in enumerate(given):
            if value is None:
                continue
            array = np.asarray(value, dtype=np.float64, order="C")
            tail = _TAILS[i]
            shape = array.shape
            if shape[len(shape) - len(tail) :] != tail:
                raise ValueError(f"{_NAMES[i]} must have the shape {_shape(tail)}, not {shape}")
            own = shape[: len(shape) - len(tail)]
            if own and own != lead:
                if lead:
                    raise ValueError(f"{_NAMES[i]} is given for the shape {own}, the arguments before it for {lead}")
                lead = own
            arrays[i] = array
        items = 1
        for size in lead:
            items *= size
        outputs = [None if tail is None else np.empty(lead + tail) for tail in tails]
        refused = _gough.each(function, self._handle, items, self.threads, *arrays, *outputs, *([None] * (4 - len(outputs))))
        if refused is not None:
            self._refuse(function, refused, items)
        return tuple(outputs)

    def _refuse(self, function: int, item: int, items: int) -> None:
        what = f"pose {item} of {items}, counted from 0: " if items > 1 else ""
        more = ", or a screw locks itself (efficiency of 0.5 or less)" if function == _FORWARD else ""
        raise ValueError(f"{what}the matrix is not a rotation{more}")

    def lengths(self, position: ArrayLike, rotation: ArrayLike | None = None) -> np.ndarray:
        """Leg lengths, joint to joint [m], shape (..., 6), of `position` (..., 3) [m] and `rotation` (..., 3, 3)."""
        return self._each(_KINEMATICS, (position, self._unit if rotation is None else rotation), ((6,),))[0]

    def rates(
        self, position: ArrayLike, rotation: ArrayLike | None = None, velocity: ArrayLike | None = None, angular_velocity: ArrayLike | None = None
    ) -> np.ndarray:
        """Rates of the leg lengths [m/s], shape (..., 6); `velocity` of the origin of the top frame [m/s] and `angular_velocity`
        [rad/s], both (..., 3) in base axes."""
        given = (position, self._unit if rotation is None else rotation, velocity, angular_velocity)
        return self._each(_KINEMATICS, given, (None, (6,)))[1]

    def jacobian(self, position: ArrayLike, rotation: ArrayLike | None = None) -> np.ndarray:
        """Jacobian of the leg lengths, shape (..., 6, 6): rates = J (v, ω), with v of the origin of the top frame and ω in base axes.
        The first three columns have no unit, the last three are in m."""
        return self._each(_JACOBIAN, (position, self._unit if rotation is None else rotation), ((6, 6),))[0]

    def conditioning(self, position: ArrayLike, rotation: ArrayLike | None = None) -> Conditioning:
        """Condition number and determinant of poses, each of shape (...)."""
        return Conditioning(*self._each(_CONDITIONING, (position, self._unit if rotation is None else rotation), ((), ())))

    def inverse_dynamics(
        self,
        position: ArrayLike,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        angular_acceleration: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
    ) -> np.ndarray:
        """Leg forces [N], shape (..., 6), that give the top an acceleration; a push is positive.

        `acceleration` (..., 3) is that of the origin of the top frame [m/s²], `angular_acceleration` (..., 3) in rad/s², both in
        base axes; `wrench` (..., 6) is a force on the load at its centre of mass [N] and a moment [N m], base axes. What is left
        out is 0.
        """
        given = (position, self._unit if rotation is None else rotation, velocity, angular_velocity, acceleration, angular_acceleration, None, wrench)
        return self._each(_INVERSE, given, ((6,),))[0]

    def lengths_and_forces(
        self,
        position: ArrayLike,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        angular_acceleration: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Leg lengths [m] and the forces of `inverse_dynamics` [N] in one call, each of shape (..., 6)."""
        given = (position, self._unit if rotation is None else rotation, velocity, angular_velocity, acceleration, angular_acceleration, None, wrench)
        force, _, length = self._each(_INVERSE, given, ((6,), None, (6,)))
        return length, force

    def forward_dynamics(
        self,
        position: ArrayLike,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        force: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
    ) -> Accelerations:
        """Accelerations of the top under the leg forces `force` (..., 6) [N] and `wrench` (..., 6), as in `inverse_dynamics`."""
        given = (position, self._unit if rotation is None else rotation, velocity, angular_velocity, None, None, force, wrench)
        return Accelerations(*self._each(_FORWARD, given, ((3,), (3,))))

    def joint_forces(
        self,
        position: ArrayLike,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        angular_acceleration: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
    ) -> JointForces:
        """Forces at the joints of the legs that an acceleration needs; arguments as in `inverse_dynamics`."""
        given = (position, self._unit if rotation is None else rotation, velocity, angular_velocity, acceleration, angular_acceleration, None, wrench)
        return JointForces(*self._each(_JOINTS, given, ((6,), (6, 3), (6, 3), (6,))))

    def pose(
        self,
        lengths: ArrayLike,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        *,
        follow: bool = False,
        most_steps: int = 1000,
    ) -> Followed:
        """The poses from leg lengths (..., 6) [m] that are joined to known ones, with a certificate (forward kinematics).

        `position` and `rotation` are where each way begins; home if left out. With `follow`, the lengths are a record along the
        first axis: the first way begins there, and each other where the one before it ended, so that the record is one course.
        A way that is not certain to its end, because it meets a singular pose or needs more than `most_steps` steps, ends at the
        last pose that is certain, and its ``reached`` is below 1.
        """
        given = np.ascontiguousarray(lengths, dtype=np.float64)
        if given.shape[-1:] != (6,):
            raise ValueError(f"lengths must have the shape (..., 6), not {given.shape}")
        lead = given.shape[:-1]
        if follow and len(lead) != 1:
            raise ValueError(f"a record to follow has the shape (rows, 6), not {given.shape}")
        home = (0, 0, self.height)
        place = _filled(home if position is None else position, lead + (3,))
        turn = _filled(self._unit if rotation is None else rotation, lead + (3, 3))
        certificate = np.empty(lead + (5,))
        items = given.size // 6
        if items:
            _gough.follow(self._handle, items, self.threads, most_steps, follow, given, place, turn, certificate)
        return Followed(place, turn, *(certificate[..., i] for i in range(4)))

    def step(
        self,
        position: ArrayLike,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike = (0, 0, 0),
        angular_velocity: ArrayLike = (0, 0, 0),
        force: ArrayLike = (0, 0, 0, 0, 0, 0),
        wrench: ArrayLike | None = None,
        *,
        step: float,
        steps: int = 1,
    ) -> Moved:
        """Moves states by `steps` fixed RK4 steps of `step` [s] under drive forces (..., 6) [N] that are held.

        For many calls with the same number of states `Plants` is quicker, because it keeps them between calls. A drive that lags
        begins with `force`.
        """
        from ._vector import Plants

        place = np.asarray(position, dtype=np.float64)
        lead = place.shape[:-1]
        count = int(np.prod(lead, dtype=np.int64))

        def flat(value: ArrayLike, tail: tuple) -> np.ndarray:
            return _filled(value, lead + tail).reshape((count,) + tail)

        plants = Plants(self.study, count, step, threads=self.threads)
        turn = flat(self._unit if rotation is None else rotation, (3, 3))
        plants.put(
            position=flat(place, (3,)), rotation=turn, velocity=flat(velocity, (3,)), angular_velocity=flat(angular_velocity, (3,))
        )
        plants.move(flat(force, (6,)), steps, None if wrench is None else flat(wrench, (6,)))
        shown = (plants.position, plants.rotation, plants.velocity, plants.angular_velocity, plants.ended)
        return Moved(*(np.array(array).reshape(lead + array.shape[1:]) for array in shown))

    def __repr__(self) -> str:
        return f"<gough.Machine of {self.study.title or self.study.name!r}>"


def _filled(value: ArrayLike, shape: tuple) -> np.ndarray:
    """A new array of this shape with these numbers."""
    array = np.empty(shape)
    array[...] = value
    return array


def _shape(tail: tuple) -> str:
    return "(..., " + ", ".join(map(str, tail)) + ")"
