# Motion of a ship's deck in an irregular sea, as six columns.
#
#     awk -f ship-deck.awk > ship-deck.csv
#
# prints t,surge,sway,heave,roll,pitch,yaw: 120 s, 20 rows a second, metres and degrees; x forward,
# y to port, z up. Options: -v height=4 (significant wave height, m), -v peak=9 (peak period, s),
# -v scale=0.25, -v seed=1961 (with LC_ALL=C before awk where the locale has a decimal comma).
#
# The sea is a JONSWAP spectrum in the form of the International Towing Tank Conference, peak
# enhancement 3.3, cut into bands; each band is one long-crested wave whose amplitude is that of its
# energy and whose phase and frequency within the band are drawn at random. A frigate-sized ship
# meets it on the bow. Her responses are plausible transfer functions, not measured ones: each is
# the forcing of a slender hull (waves shorter than the hull cancel along it, and die out with
# draught) on an oscillator. `scale` shrinks the displacements to what a platform can do, as
# simulators do; the angles are the ship's own. A minimum-jerk ramp over the first 12 s lets the
# motion start from rest at home.
#
# awk's own rand differs between programs and its sin and exp between libraries (some busybox have
# neither), so all three are here: every awk prints the same digits.

# Uniform in (0, 1): the multiplicative generator 16807 · x mod 2³¹ − 1 of Park and Miller; exact in doubles.
function uniform() {
    state = (16807 * state) % 2147483647
    return state / 2147483647
}

# sin(x): to within a turn of 0, then its series.
function sine_of(x,    turns, term, sum, n) {
    turns = x / 6.283185307179586
    x -= 6.283185307179586 * int(turns + (turns < 0 ? -0.5 : 0.5))
    term = sum = x
    for (n = 2; n < 30; n += 2) {
        term *= -x * x / (n * (n + 1))
        sum += term
    }
    return sum
}
function cosine_of(x) { return sine_of(x + 1.5707963267948966) }

# exp(x) for x <= 1: the series for x/1024, squared ten times.
function exponential(x,    term, sum, n) {
    if (x < -700) return 0
    x /= 1024
    term = sum = 1
    for (n = 1; n < 12; n++) {
        term *= x / n
        sum += term
    }
    for (n = 0; n < 10; n++) sum *= sum
    return sum
}

# √x by Heron's rule.
function root(x,    r, n) {
    if (x <= 0) return 0
    r = x < 1 ? 1 : x
    for (n = 0; n < 60; n++) r = (r + x / r) / 2
    return r
}

# Spectral density in m² s of waves of frequency w (rad/s); t1 is the mean period 0.834 · peak period.
function spectrum(w, height, t1,    w4, width, bump) {
    w4 = w * w * w * w
    width = (w * t1 <= 5.24) ? 0.07 : 0.09
    bump = (0.191 * w * t1 - 1) / width
    bump = exponential(-bump * bump / 2)
    return 155 * height * height / (t1 * t1 * t1 * t1 * w4 * w) * \
           exponential(-944 / (t1 * t1 * t1 * t1 * w4)) * exponential(bump * 1.1939224684724346)
}

# x as text with a decimal point, whatever the locale, and no minus sign before a zero.
function written(format, x,    text) {
    text = sprintf(format, (x < 5e-10 && x > -5e-10) ? 0 : x)
    sub(",", ".", text)
    return text
}

# sin(x)/x, the mean of a wave along the hull.
function along(x) { return (x < 0.001 && x > -0.001) ? 1 : sine_of(x) / x }

# Response m to wave n: what the force re + i im at frequency w does to an oscillator of frequency w0
# and damping ratio z.
function respond(m, n, re, im, w, w0, z,    a, b, size) {
    a = 1 - w * w / (w0 * w0)
    b = 2 * z * w / w0
    size = a * a + b * b
    real[m, n] = (re * a + im * b) / size
    imag[m, n] = (im * a - re * b) / size
}

BEGIN {
    if (height == "") height = 4
    if (peak == "") peak = 9
    if (scale == "") scale = 0.25
    if (seed == "") seed = 1961

    pi = 3.14159265358979323846
    gravity = 9.80665
    waves = 80                 # bands of the spectrum
    lowest = 0.35              # rad/s, from here …
    highest = 1.9              # … to here lies 98 % of the energy
    duration = 120
    rows_per_second = 20
    ramp = 12                  # s

    hull = 110                 # length, m
    draught = 4.5              # m
    speed = 5                  # m/s
    cosine = -root(0.5)        # waves come from 45° off the bow, to starboard: they run aft …
    sine = root(0.5)           # … and to port
    deck_x = -38               # the flight deck, aft of the centre of mass (m)
    deck_z = 5                 # and above it

    state = seed
    for (n = 0; n < 10; n++) uniform()

    for (n = 0; n < waves; n++) {
        band = (highest - lowest) / waves
        w = lowest + band * (n + uniform())
        phase = 2 * pi * uniform()
        amplitude = root(2 * spectrum(w, height, 0.834 * peak) * band)

        # Deep water: wave number k; the moving ship meets the wave at frequency met.
        k = w * w / gravity
        met = w - k * speed * cosine
        x = k * hull * cosine / 2
        calm = exponential(-k * draught / 2)
        hold = calm * along(x)
        twist = calm * (along(x) - cosine_of(x)) / x

        # Orbits carry the hull along, a quarter period behind the crest; slopes turn it.
        respond("surge", n, 0, -0.8 * cosine * hold, met, 9, 0.7)
        respond("sway", n, 0, -0.8 * sine * hold, met, 9, 0.7)
        respond("heave", n, hold, 0, met, 1.1, 0.35)
        respond("roll", n, 0, -k * sine * hold, met, 0.68, 0.12)
        respond("pitch", n, 0, k * cosine * hold, met, 1.2, 0.4)
        respond("yaw", n, -0.8 * 6 / hull * sine * twist, 0, met, 9, 0.7)

        # The wave at the ship as a turning arrow, and its turn from row to row.
        arrow_re[n] = amplitude * cosine_of(phase)
        arrow_im[n] = amplitude * sine_of(phase)
        turn_re[n] = cosine_of(met / rows_per_second)
        turn_im[n] = sine_of(met / rows_per_second)

        # The deck is not at the centre of mass: v + ω × d for small angles.
        deck("re", real, n)
        deck("im", imag, n)
    }

    printf "t,surge,sway,heave,roll,pitch,yaw\n"
    for (row = 0; row <= duration * rows_per_second; row++) {
        t = row / rows_per_second
        s = (t < ramp) ? t / ramp : 1
        factor = s * s * s * (10 - s * (15 - 6 * s))
        line = written("%.2f", t)
        for (m = 1; m <= 6; m++) sum[m] = 0
        for (n = 0; n < waves; n++) {
            c = arrow_re[n]
            d = arrow_im[n]
            for (m = 1; m <= 6; m++) sum[m] += motion["re", m, n] * c - motion["im", m, n] * d
            arrow_re[n] = c * turn_re[n] - d * turn_im[n]
            arrow_im[n] = c * turn_im[n] + d * turn_re[n]
        }
        for (m = 1; m <= 6; m++)
            line = line "," written("%.9f", factor * sum[m] * (m > 3 ? 180 / pi : scale))
        print line
    }
}

# The six motions of the deck to wave n, real or imaginary part.
function deck(part, of, n) {
    motion[part, 1, n] = of["surge", n] + deck_z * of["pitch", n]
    motion[part, 2, n] = of["sway", n] - deck_z * of["roll", n] + deck_x * of["yaw", n]
    motion[part, 3, n] = of["heave", n] - deck_x * of["pitch", n]
    motion[part, 4, n] = of["roll", n]
    motion[part, 5, n] = of["pitch", n]
    motion[part, 6, n] = of["yaw", n]
}
