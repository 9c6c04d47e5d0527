// Counts the operations of the kernels: their own texts, compiled over a double that counts what is done to it.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <type_traits>

namespace {

struct tally {
    long add_multiply, divide, root, compare;
};
tally counted;

struct counting {
    double v;

    counting() = default;
    template <class T, class = std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>>>
    constexpr counting(T x) : v(static_cast<double>(x)) {}
    template <class T, class = std::enable_if_t<std::is_arithmetic_v<T>>>
    explicit operator T() const {
        return static_cast<T>(v);
    }
    counting operator-() const { return counting(-v); }
};

template <class A, class B>
using either = std::enable_if_t<std::is_same_v<A, counting> || std::is_same_v<B, counting>>;

#define COUNTING(sign, what)                                                                       \
    template <class A, class B, class = either<A, B>> counting operator sign(A a, B b) {           \
        counted.what++;                                                                            \
        return counting(double(a) sign double(b));                                                 \
    }                                                                                              \
    template <class B> counting &operator sign##=(counting &a, B b) { return a = a sign b; }
COUNTING(+, add_multiply)
COUNTING(-, add_multiply)
COUNTING(*, add_multiply)
COUNTING(/, divide)

#define COMPARING(sign)                                                                            \
    template <class A, class B, class = either<A, B>> bool operator sign(A a, B b) {               \
        counted.compare++;                                                                         \
        return double(a) sign double(b);                                                           \
    }
COMPARING(<)
COMPARING(>)
COMPARING(<=)
COMPARING(>=)
COMPARING(==)
COMPARING(!=)

counting sqrt(counting x) { return counted.root++, counting(std::sqrt(x.v)); }

// of the program's formulas, which are not counted
#define UNCOUNTED(name)                                                                            \
    counting name(counting x) { return counting(std::name(x.v)); }
UNCOUNTED(sin)
UNCOUNTED(cos)
UNCOUNTED(tan)
UNCOUNTED(asin)
UNCOUNTED(acos)
UNCOUNTED(atan)
UNCOUNTED(exp)
UNCOUNTED(log)
UNCOUNTED(tanh)
UNCOUNTED(floor)
UNCOUNTED(ceil)
UNCOUNTED(fabs)
counting pow(counting x, counting y) { return counting(std::pow(x.v, y.v)); }
counting atan2(counting y, counting x) { return counting(std::atan2(y.v, x.v)); }
counting hypot(counting x, counting y) { return counting(std::hypot(x.v, y.v)); }

} // namespace

#define restrict
#define NUMBER_DOUBLE
#define double counting
#include "bench/kernels.h"
#include "integrate/rk4.h"
#include "system/system.h"

static tally since(const tally &before) {
    return tally{counted.add_multiply - before.add_multiply, counted.divide - before.divide,
                 counted.root - before.root, counted.compare - before.compare};
}

static void hold(struct system *, real) {}

static kernel_flops flops(const tally &t) {
    return kernel_flops{t.add_multiply, t.divide, t.root, t.compare};
}

// the layout of a reference is that of the C program: a counting double is a double
extern "C" int kernels_count(const reference *ref, kernel_counts *counts) {
    static struct system r;
    static gough_simulation options;
    system_lane lane = {};
    lane.machine = &ref->model.machine;
    lane.control = &ref->model.control;
    lane.disturbance = &ref->model.disturbance;
    number y[STATE_SIZE], rate[STATE_SIZE], raw[STATE_SIZE], wrench[1][6];
    rattle_state s;
    signals m;
    legs g;

    options.constraints = GOUGH_PROJECTION;
    system_begin(&r, &ref->model.motion, &options, &lane);
    system_wanted(&r, 5);
    r.provide = hold;
    coordinates x = r.now.x[0], v = r.now.x[1];
    const vector none = {number_of(0), number_of(0), number_of(0)};
    coordinates_store(&x, y);
    coordinates_store(&v, y + COORDINATES);

    tally before = counted;
    system_rates(&r, 5, y, rate);
    counts->right_hand_side = flops(since(before));

    system_signals(&r, 5, y, &m);
    before = counted;
    legs_at(&r.h, &m.x, &g);
    required_wrench(&r.h, &m.x, &m.rate, &m.acceleration, none, none, wrench[0]);
    leg_forces_of(&r.h, &m.x, &g, wrench, 1);
    counts->inverse_dynamics = flops(since(before));

    // a step with the rate at its beginning, and the constraints kept at its end
    before = counted;
    system_rates(&r, 5, y, rate);
    rk4_step(system_rates, &r, r.states, 5, 0.001, y, rate, raw);
    x = coordinates_load(raw), v = coordinates_load(raw + COORDINATES);
    coordinates_project(&x, &v);
    counts->rk4_step = flops(since(before));

    const rattle rule = {&r.h.load, r.traits & MOVING_MASS ? &r.h : nullptr, system_wrench, &r, 0};
    s.x = x;
    s.velocity = v.rho;
    s.omega = none;
    rattle_begin(&rule, 5, &s);
    before = counted;
    rattle_compose(&rule, 0, 5, 0.001, &s);
    counts->rattle2_step = flops(since(before));
    return 1;
}
