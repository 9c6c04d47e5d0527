"""Newton's and Euler's equations of a rigid load on six straight legs, for the campaign of random studies.

A formulation of its own that shares no line with the library: rotation matrices and a quaternion, moments about the centre of
mass, angular velocity in body axes, plain Python floats. Consistent units, radians, base axes unless a name ends in _body. A
program is six jets (value, first and second derivative); a load is Newton's law plus Euler's equation; a run is extrapolated
with its error estimated (Gragg, Bulirsch, Stoer).
"""
import math

LEGS = 6


# ---- vectors and small matrices -------------------------------------------------------------------------------------

def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(s, a):
    return (s * a[0], s * a[1], s * a[2])


def norm(a):
    return math.sqrt(dot(a, a))


def apply(A, v):
    """A v"""
    return (dot(A[0], v), dot(A[1], v), dot(A[2], v))


def apply_back(A, v):
    """A^T v"""
    return (A[0][0] * v[0] + A[1][0] * v[1] + A[2][0] * v[2],
            A[0][1] * v[0] + A[1][1] * v[1] + A[2][1] * v[2],
            A[0][2] * v[0] + A[1][2] * v[1] + A[2][2] * v[2])


def inverse3(A):
    """Inverse of a symmetric 3 x 3 matrix by cofactors."""
    c0, c1, c2 = cross(A[1], A[2]), cross(A[2], A[0]), cross(A[0], A[1])
    determinant = dot(A[0], c0)
    return tuple(tuple(c[k] / determinant for c in (c0, c1, c2)) for k in range(3))


def solve6(A, b):
    """x of A x = b with rows exchanged; A is a list of 6 lists, destroyed. Returns (x, determinant)."""
    determinant = 1.0
    rows = [row + [value] for row, value in zip(A, b)]
    for c in range(6):
        best = max(range(c, 6), key=lambda r: abs(rows[r][c]))
        if best != c:
            rows[c], rows[best] = rows[best], rows[c]
            determinant = -determinant
        pivot = rows[c]
        determinant *= pivot[c]
        if determinant == 0:
            return None, 0.0
        for r in range(c + 1, 6):
            row = rows[r]
            factor = row[c] / pivot[c]
            if factor:
                for k in range(c + 1, 7):
                    row[k] -= factor * pivot[k]
    x = [0.0] * 6
    for r in range(5, -1, -1):
        row = rows[r]
        total = row[6]
        for k in range(r + 1, 6):
            total -= row[k] * x[k]
        x[r] = total / row[r]
    return x, determinant


def eigen(S, want_vectors=True):
    """Eigenvalues and eigenvectors (as columns) of a symmetric matrix by Jacobi's rotations."""
    n = len(S)
    S = [list(row) for row in S]
    V = [[float(i == j) for j in range(n)] for i in range(n)]
    for _ in range(60):
        largest = max(abs(S[i][i]) for i in range(n))
        off = max((abs(S[p][q]) for p in range(n) for q in range(p + 1, n)), default=0)
        if off <= 1e-18 * largest:
            break
        for p in range(n - 1):
            for q in range(p + 1, n):
                if S[p][q] == 0:
                    continue
                theta = (S[q][q] - S[p][p]) / (2 * S[p][q])
                t = math.copysign(1, theta) / (abs(theta) + math.hypot(theta, 1))
                c = 1 / math.hypot(t, 1)
                s = t * c
                for k in range(n):
                    a, b = S[k][p], S[k][q]
                    S[k][p], S[k][q] = c * a - s * b, s * a + c * b
                for k in range(n):
                    a, b = S[p][k], S[q][k]
                    S[p][k], S[q][k] = c * a - s * b, s * a + c * b
                if want_vectors:
                    for row in V:
                        a, b = row[p], row[q]
                        row[p], row[q] = c * a - s * b, s * a + c * b
    return [S[i][i] for i in range(n)], V


def extreme_eigenvalues(S):
    """Least and greatest eigenvalue of a symmetric matrix: Householder's tridiagonal form, then Sturm's count halved."""
    n = len(S)
    S = [list(row) for row in S]
    off = [0.0] * n
    for k in range(n - 2):
        v = [0.0] * (k + 1) + [S[i][k] for i in range(k + 1, n)]
        size = math.sqrt(sum(x * x for x in v))
        off[k] = -math.copysign(size, v[k + 1])
        v[k + 1] -= off[k]
        square = sum(x * x for x in v)
        if square == 0:
            continue
        # H S H with H = 1 - 2 v v^T / |v|^2, as S - v w^T - w v^T
        p = [2 * sum(a * b for a, b in zip(row, v)) / square for row in S]
        shift = sum(a * b for a, b in zip(p, v)) / square
        w = [a - shift * b for a, b in zip(p, v)]
        S = [[x - a * d - c * b for x, b, d in zip(row, v, w)] for row, a, c in zip(S, v, w)]
    off[n - 2] = S[n - 1][n - 2]
    diagonal, squares = [S[i][i] for i in range(n)], [x * x for x in off]

    def below(x):
        count, d = 0, 1.0
        for i in range(n):
            d = diagonal[i] - x - (squares[i - 1] / d if i else 0)
            if d == 0:
                d = 1e-300
            count += d < 0
        return count

    bound = max(abs(diagonal[i]) + abs(off[i]) + (abs(off[i - 1]) if i else 0) for i in range(n))
    ends = []
    for wanted in (1, n):
        low, high = -bound, bound
        while high - low > 4e-16 * max(abs(low), abs(high)):
            middle = (low + high) / 2
            if middle in (low, high):
                break
            low, high = (low, middle) if below(middle) >= wanted else (middle, high)
        ends.append((low + high) / 2)
    return ends


# ---- rotations ------------------------------------------------------------------------------------------------------

def rotation(roll, pitch, yaw):
    """Rz(yaw) Ry(pitch) Rx(roll) as a product of three matrices."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    X = ((1, 0, 0), (0, cr, -sr), (0, sr, cr))
    Y = ((cp, 0, sp), (0, 1, 0), (-sp, 0, cp))
    Z = ((cy, -sy, 0), (sy, cy, 0), (0, 0, 1))
    return product(product(Z, Y), X)


def product(A, B):
    return tuple(tuple(A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j] for j in range(3)) for i in range(3))


def angles(R):
    return (math.atan2(R[2][1], R[2][2]), math.atan2(-R[2][0], math.hypot(R[0][0], R[1][0])), math.atan2(R[1][0], R[0][0]))


def rotation_of_quaternion(q):
    w, x, y, z = q
    s = 2 / (w * w + x * x + y * y + z * z)
    return ((1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)),
            (s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)),
            (s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)))


def quaternion_product(p, q):
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def quaternion(roll, pitch, yaw):
    about_z = (math.cos(yaw / 2), 0, 0, math.sin(yaw / 2))
    about_y = (math.cos(pitch / 2), 0, math.sin(pitch / 2), 0)
    about_x = (math.cos(roll / 2), math.sin(roll / 2), 0, 0)
    return quaternion_product(quaternion_product(about_z, about_y), about_x)


def turn_between(A, B):
    """Angle of the rotation that carries B into A, from its half: |A − B| = 2 sqrt 2 sin(angle/2) in Frobenius' norm."""
    gap = math.sqrt(sum((A[i][j] - B[i][j]) ** 2 for i in range(3) for j in range(3)))
    return 2 * math.asin(min(1.0, gap / math.sqrt(8)))


def angle_between(a, b):
    return math.atan2(norm(cross(a, b)), dot(a, b))


# ---- the machine ----------------------------------------------------------------------------------------------------

class Pose:
    """Position and rotation of the top frame with first and second derivatives; the legs in it."""

    def __init__(self, machine, p, R, v, omega, a=None, alpha=None):
        self.machine, self.p, self.R, self.v, self.omega, self.a, self.alpha = machine, p, R, v, omega, a, alpha
        self.arm, self.direction, self.length, self.rate = [], [], [], []
        # written out by components: half of the campaign's time goes by here
        ((a11, a12, a13), (a21, a22, a23), (a31, a32, a33)), (px, py, pz), (vx, vy, vz), (wx, wy, wz) = R, p, v, omega
        for (x, y, z), (bx, by, bz) in zip(machine.top, machine.base):
            x, y, z = a11 * x + a12 * y + a13 * z, a21 * x + a22 * y + a23 * z, a31 * x + a32 * y + a33 * z
            lx, ly, lz = px + x - bx, py + y - by, pz + z - bz
            length = math.sqrt(lx * lx + ly * ly + lz * lz)
            lx, ly, lz = lx / length, ly / length, lz / length
            self.arm.append((x, y, z))
            self.direction.append((lx, ly, lz))
            self.length.append(length)
            self.rate.append(lx * (vx + wy * z - wz * y) + ly * (vy + wz * x - wx * z) + lz * (vz + wx * y - wy * x))

    def centre(self):
        """Position, velocity and (where known) acceleration of the centre of mass."""
        arm = apply(self.R, self.machine.centre)
        turn = cross(self.omega, arm)
        c, v = add(self.p, arm), add(self.v, turn)
        if self.a is None:
            return c, v, None
        return c, v, add(self.a, add(cross(self.alpha, arm), cross(self.omega, turn)))

    def equations(self):
        """Columns: force, and moment about the centre of mass, of a unit force in each leg; as rows of a 6 x 6 matrix."""
        centre = apply(self.R, self.machine.centre)
        moments = [cross(sub(arm, centre), n) for arm, n in zip(self.arm, self.direction)]
        return [[n[k] for n in self.direction] for k in range(3)] + [[m[k] for m in moments] for k in range(3)]

    def balance(self, force, moment):
        """Leg forces with this resultant and this moment about the centre of mass."""
        return solve6(self.equations(), list(force) + list(moment))[0]

    def jacobian(self):
        """Rows (n, R a × n): rates of the legs from the velocity of the top frame's origin and the angular velocity."""
        return [list(n) + list(cross(arm, n)) for arm, n in zip(self.arm, self.direction)]

    def scaled_normal(self):
        """J^T J of the Jacobian whose moments are divided by the mean arm of the top joints."""
        s = self.machine.arm
        rows = [row[:3] + [x / s for x in row[3:]] for row in self.jacobian()]
        return [[sum(row[i] * row[j] for row in rows) for j in range(6)] for i in range(6)]

    def singular_values(self):
        values, vectors = eigen(self.scaled_normal())
        return [math.sqrt(max(0.0, x)) for x in values], vectors

    def condition(self):
        least, greatest = extreme_eigenvalues(self.scaled_normal())
        return math.sqrt(greatest / least) if least > 0 else math.inf

    def required(self):
        """Force and moment about the centre of mass that the legs must give for this motion."""
        m = self.machine
        acceleration = self.centre()[2]
        force = scaled(m.mass, sub(acceleration, m.gravity))
        w, dw = apply_back(self.R, self.omega), apply_back(self.R, self.alpha)
        moment = add(apply(m.inertia, dw), cross(w, apply(m.inertia, w)))
        return force, apply(self.R, moment)


class Machine:
    def __init__(self, base, top, height, mass, centre, inertia, gravity, about):
        self.base, self.top, self.height, self.mass, self.centre = base, top, height, mass, centre
        self.inertia, self.gravity, self.about = inertia, gravity, about
        self.inertia_inverse = inverse3(inertia)
        self.arm = sum(norm(a) for a in top) / LEGS
        self.base_radius, self.top_radius = mean_radius(base), mean_radius(top)
        self.home = Pose(self, (0, 0, height), ((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 0, 0))

    def units(self):
        """Length, mass and time of the dimensionless form."""
        g = norm(self.gravity)
        return self.base_radius, self.mass, math.sqrt(self.base_radius / g) if g > 0 else math.nan

    def program_pose(self, jets):
        """The pose that six jets (surge … yaw, each value, rate, second rate) of the point `about` ask for."""
        s, ds, dds = ([jets[k][order] for k in range(3)] for order in range(3))
        (roll, droll, ddroll), (pitch, dpitch, ddpitch), (yaw, dyaw, ddyaw) = jets[3:]
        R = rotation(roll, pitch, yaw)
        # the axis of yaw stands still, that of pitch is turned by yaw, that of roll by both
        e_yaw, e_pitch = (0, 0, 1), (-math.sin(yaw), math.cos(yaw), 0)
        e_roll = (R[0][0], R[1][0], R[2][0])
        w_yaw = scaled(dyaw, e_yaw)
        w_pitch = add(w_yaw, scaled(dpitch, e_pitch))
        omega = add(w_pitch, scaled(droll, e_roll))
        alpha = add(add(scaled(ddyaw, e_yaw), scaled(ddpitch, e_pitch)), scaled(ddroll, e_roll))
        alpha = add(alpha, add(scaled(dpitch, cross(w_yaw, e_pitch)), scaled(droll, cross(w_pitch, e_roll))))
        # the top frame's origin seen from the point: R (−about)
        back = apply(R, scaled(-1, self.about))
        turn = cross(omega, back)
        p = add(add((0, 0, self.height), add(self.about, s)), back)
        v = add(ds, turn)
        a = add(dds, add(cross(alpha, back), cross(omega, turn)))
        return Pose(self, p, R, v, omega, a, alpha)


def mean_radius(points):
    middle = [sum(p[k] for p in points) / LEGS for k in range(3)]
    return sum(norm(sub(p, middle)) for p in points) / LEGS


# ---- motion under control and disturbance ---------------------------------------------------------------------------

class Plant:
    """What moves: `program(t)` gives six jets, `disturbance(t)` gives (six leg forces, vertical, force, moment)."""

    def __init__(self, machine, program, feedforward, stiffness, damping, disturbance):
        self.machine, self.program, self.feedforward = machine, program, feedforward
        self.stiffness, self.damping, self.disturbance = stiffness, damping, disturbance
        self.evaluations, self.known = 0, {}

    def program_pose(self, t):
        return self.machine.program_pose(self.program(t))

    def program_forces(self, pose):
        return pose.balance(*pose.required())

    def of_time(self, t):
        """What depends on time alone: the program's pose, the forces that are given, force and moment on the load."""
        if t in self.known:
            return self.known[t]
        wanted = self.program_pose(t)
        extra, vertical, force, moment = self.disturbance(t) if self.disturbance else ((0,) * 6, 0, (0,) * 3, (0,) * 3)
        given = list(extra)
        if self.feedforward:
            given = [a + b for a, b in zip(given, self.program_forces(wanted))]
        if vertical:
            given = [a + vertical * b for a, b in zip(given, wanted.balance((0, 0, 1), (0, 0, 0)))]
        if len(self.known) > 40:
            self.known.clear()
        self.known[t] = wanted, given, force, moment
        return self.known[t]

    def legs(self, t, pose):
        """Forces of the legs, force and moment on the load beside them, at t in an actual pose."""
        wanted, given, force, moment = self.of_time(t)
        u = [f + G * (lp - l) + D * (dlp - dl) for f, G, D, lp, l, dlp, dl in
             zip(given, self.stiffness, self.damping, wanted.length, pose.length, wanted.rate, pose.rate)]
        return u, force, moment

    def pose_of(self, state):
        R = rotation_of_quaternion(state[3:7])
        omega = apply(R, state[10:13])
        arm = apply(R, self.machine.centre)
        return Pose(self.machine, sub(state[0:3], arm), R, sub(state[7:10], cross(omega, arm)), omega)

    def accelerations(self, t, state):
        """Of the centre of mass, and of the angular velocity in body axes; with pose and leg forces."""
        m, w = self.machine, state[10:13]
        pose = self.pose_of(state)
        u, force, moment = self.legs(t, pose)
        centre = apply(pose.R, m.centre)
        (fx, fy, fz), (mx, my, mz), (cx, cy, cz) = force, moment, centre
        for f, (nx, ny, nz), (x, y, z) in zip(u, pose.direction, pose.arm):
            nx, ny, nz, x, y, z = f * nx, f * ny, f * nz, x - cx, y - cy, z - cz
            fx, fy, fz = fx + nx, fy + ny, fz + nz
            mx, my, mz = mx + y * nz - z * ny, my + z * nx - x * nz, mz + x * ny - y * nx
        force, moment = (fx, fy, fz), (mx, my, mz)
        body = sub(apply_back(pose.R, moment), cross(w, apply(m.inertia, w)))
        return add(scaled(1 / m.mass, force), m.gravity), apply(m.inertia_inverse, body), pose, u

    def full_pose(self, t, state):
        """Pose with the accelerations of the top frame, and the leg forces."""
        a, dw, pose, u = self.accelerations(t, state)
        pose.alpha = apply(pose.R, dw)
        arm = apply(pose.R, self.machine.centre)
        pose.a = sub(a, add(cross(pose.alpha, arm), cross(pose.omega, cross(pose.omega, arm))))
        return pose, u

    def derivative(self, t, state):
        """State: centre of mass, quaternion, velocity, angular velocity (body)."""
        self.evaluations += 1
        q, w = state[3:7], state[10:13]
        a, dw, _, _ = self.accelerations(t, state)
        dq = quaternion_product(q, (0, w[0] / 2, w[1] / 2, w[2] / 2))
        return (*state[7:10], *dq, *a, *dw)

    def gragg(self, t, h, n, start, slope):
        """Modified midpoint rule in n (even) substeps; its error is a series in h²/n²."""
        d = h / n
        before, now = start, [x + d * s for x, s in zip(start, slope)]
        for k in range(1, n):
            slope = self.derivative(t + h * (k / n), now)
            before, now = now, [b + 2 * d * s for b, s in zip(before, slope)]
        slope = self.derivative(t + h, now)
        return [(b + x + d * s) / 2 for b, x, s in zip(before, now, slope)]

    def step(self, t, h, state, tolerance, depth=0):
        """Extrapolates from t to t + h; in two halves where the last two orders differ by more than the tolerance."""
        slope = self.derivative(t, state)
        counts, table, change = (2, 4, 6, 8, 10, 12, 14, 16), [], math.inf
        for row, n in enumerate(counts):
            line = [self.gragg(t, h, n, state, slope)]
            for column in range(row):
                weight = (n / counts[row - column - 1]) ** 2 - 1
                line.append([a + (a - b) / weight for a, b in zip(line[column], table[row - 1][column])])
            table.append(line)
            if row >= 2:
                scale = self.scale
                change = max(abs(a - b) / s for a, b, s in zip(line[-1], line[-2], scale))
                if change <= tolerance:
                    break
        else:
            if not math.isfinite(change) or depth > 12:
                raise ArithmeticError(f"no convergence at t = {t}")
            middle = self.step(t, h / 2, state, tolerance, depth + 1)
            return self.step(t + h / 2, h / 2, middle, tolerance, depth + 1)
        end = table[-1][-1]
        size = math.sqrt(sum(x * x for x in end[3:7]))
        return (*end[:3], *(x / size for x in end[3:7]), *end[7:])

    def set_scale(self, length, time):
        """Sizes of the state's numbers, by which errors are measured."""
        self.scale = [length] * 3 + [1.0] * 4 + [length / time] * 3 + [1 / time] * 3
