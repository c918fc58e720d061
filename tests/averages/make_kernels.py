# SPDX-License-Identifier: BSD-3-Clause
"""Makes the reference for smoothing kernels: means over lines that are hard to compute, exact for the doubles given.

    /usr/bin/python3 tests/averages/make_kernels.py tests/data/good/kernels/kernels.txt.gz [--check]

Needs mpmath. A run takes seconds and gives the same bytes; --check compares all with quadrature: five minutes.

Lines "norm NAME WIDTH VALUE": the integral of a kernel g over all space.
Lines "NAME WIDTH X Y Z BX BY BZ VALUE": the mean over s from 0 to 1 of g(|(X Y Z) - s (BX BY BZ)|).
Numbers are C's hexadecimal doubles, a value is the double nearest to the exact one. With r the distance and
q = r / (2 WIDTH), the kernels are:

    gaussian    exp(-r^2 / (2 WIDTH^2))    for r < 3 WIDTH
    lucy        (1 + 3 q) (1 - q)^3        for r < 2 WIDTH
    heaviside   1                          for r < WIDTH
"""
import gzip
import itertools
import math
import random
import sys
from fractions import Fraction

from mpmath import mp

SUPPORT = {"gaussian": 3, "lucy": 2, "heaviside": 1}  # in widths
DIGITS = 60
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
# Of length 3 and orthogonal, all components short: lines askew to the axes whose distances are exact.
THIRDS = ((1.0, 2.0, 2.0), (2.0, 1.0, -2.0), (2.0, -2.0, 1.0))
SHORT_WIDTHS = (3 * 2.0**-21, 3 * 2.0**-8, 0.75, 3.0, 768.0)  # all supports, and thirds of them, are exact
LONG_WIDTHS = (1e-6, 3.7e-4, 0.01, 0.7, 1000.0)
# From a point on the edge, in supports: inwards, from edge to edge, outwards, through, askew, along the edge. Products
# are exact, and so are the ends.
EDGE_STEPS = ((0.5, 0, 0), (2, 0, 0), (-1, 0, 0), (4, 0, 0), (0.5, 0.25, 0), (-1, 0.5, 0.125), (0, 0.5, 0))
chance = random.Random(20)


# ---- exact values ----

def number(fraction):
    return mp.mpf(fraction.numerator) / fraction.denominator


def nearest_double(value):
    sign, mantissa, exponent, _ = value._mpf_
    return float((-1) ** sign * mantissa * Fraction(2) ** exponent)


def dot(a, b):
    return sum((Fraction(u) * Fraction(v) for u, v in zip(a, b)), Fraction(0))


def kernel_at(name, width, square):
    """At the root of an exact square."""
    if square >= (SUPPORT[name] * Fraction(width)) ** 2:
        return mp.mpf(0)
    if name == "gaussian":
        return mp.exp(-number(square) / (2 * mp.mpf(width) ** 2))
    if name == "lucy":
        q = mp.sqrt(number(square)) / (2 * mp.mpf(width))
        return (1 + 3 * q) * (1 - q) ** 3
    return mp.mpf(1)


def antiderivative(name, width, height_square, along):
    """Of the kernel along a line, from its foot, where the distance is least."""
    if name == "gaussian":
        peak = mp.exp(-height_square / (2 * width**2))
        return peak * width * mp.sqrt(mp.pi / 2) * mp.erf(along / (width * mp.sqrt(2)))
    if name == "lucy":  # 1 - 6 q^2 + 8 q^3 - 3 q^4
        k2 = height_square / (2 * width) ** 2
        v = along / (2 * width)
        q = mp.sqrt(k2 + v**2)
        third = v * q**3 / 4 + 3 * k2 * v * q / 8
        if k2 != 0:
            third += 3 * k2**2 * mp.asinh(v / mp.sqrt(k2)) / 8
        return 2 * width * (v - 6 * (k2 * v + v**3 / 3) + 8 * third - 3 * (k2**2 * v + 2 * k2 * v**3 / 3 + v**5 / 5))
    return along


def line_mean(name, width, point, branch):
    mp.dps = DIGITS
    support_square = (SUPPORT[name] * Fraction(width)) ** 2
    start_square, product, length_square = dot(point, point), dot(point, branch), dot(branch, branch)
    if length_square == 0:
        return kernel_at(name, width, start_square)
    end_square = start_square - 2 * product + length_square
    height_square = start_square - product**2 / length_square
    # All of these decisions are exact: a line that only touches the support has no part in it.
    starts_inside, ends_inside = start_square < support_square, end_square < support_square
    if height_square >= support_square:
        return mp.mpf(0)
    if (not starts_inside and product <= 0) or (not ends_inside and product >= length_square):
        return mp.mpf(0)
    value = mp.mpf(0)
    while True:
        length = mp.sqrt(number(length_square))
        half_chord = mp.sqrt(number(support_square - height_square))
        first = -number(product) / length if starts_inside else -half_chord
        last = number(length_square - product) / length if ends_inside else half_chord
        part = [antiderivative(name, mp.mpf(width), number(height_square), along) for along in (first, last)]
        coarse, value = value, (part[1] - part[0]) / length
        # The difference loses more digits the shorter the branch is and the closer to the edge, all of them at first.
        if value > 0 and abs(value - coarse) <= value * mp.mpf(10) ** (-DIGITS // 2):
            return value
        mp.dps *= 2


def norm(name, width):
    mp.dps = DIGITS
    cube = mp.mpf(width) ** 3
    if name == "gaussian":
        return 4 * mp.pi * cube * (mp.sqrt(mp.pi / 2) * mp.erf(3 / mp.sqrt(2)) - 3 * mp.exp(mp.mpf(-9) / 2))
    return 128 * mp.pi * cube / 105 if name == "lucy" else 4 * mp.pi * cube / 3


# ---- the same by quadrature ----

def plain_kernel(name, width, distance):
    if distance >= SUPPORT[name] * width:
        return mp.mpf(0)
    q = distance / (2 * width)
    return {"gaussian": mp.exp(-2 * q**2), "lucy": (1 + 3 * q) * (1 - q) ** 3, "heaviside": mp.mpf(1)}[name]


def quadrature_mean(name, width, point, branch):
    mp.dps = 110
    width, point, branch = mp.mpf(width), mp.matrix(point), mp.matrix(branch)

    def at(s):
        return plain_kernel(name, width, mp.norm(point - s * branch))

    length_square = mp.fdot(branch, branch)
    if length_square == 0:
        return at(0)
    foot = mp.fdot(point, branch) / length_square
    inside = (SUPPORT[name] * width) ** 2 - mp.fdot(point, point) + foot**2 * length_square
    reach = mp.sqrt(max(inside, 0) / length_square)
    ends = sorted(min(max(s, mp.mpf(0)), mp.mpf(1)) for s in (0, foot - reach, foot, foot + reach, 1))
    return mp.fsum(mp.quad(at, part) for part in itertools.pairwise(ends) if part[0] != part[1])


def quadrature_norm(name, width):
    mp.dps = DIGITS
    width = mp.mpf(width)
    return mp.quad(lambda r: 4 * mp.pi * r**2 * plain_kernel(name, width, r), [0, SUPPORT[name] * width])


def check(value, other, *what):
    # A line that touches the support has a chord of 0 that rounding makes 10^-55 of the support.
    if abs(value - other) > abs(value) * mp.mpf(10) ** -25 + mp.mpf(10) ** -50:
        sys.exit(f"{what}: {mp.nstr(value, 30)}, by quadrature {mp.nstr(other, 30)}")


# ---- cases ----

def scaled(vector, factor):
    return tuple(factor * c for c in vector)


def plus(a, b):
    return tuple(u + v for u, v in zip(a, b))


def minus(a, b):
    return tuple(u - v for u, v in zip(a, b))


def direction():
    while True:
        vector = tuple(chance.uniform(-1, 1) for _ in range(3))
        length = math.sqrt(sum(c * c for c in vector))
        if 0.1 < length < 1:
            return scaled(vector, 1 / length)


def frame():
    """Two directions at a right angle, as well as doubles allow."""
    along, other = direction(), direction()
    product = sum(u * v for u, v in zip(along, other))
    across = minus(other, scaled(along, product))
    return along, scaled(across, 1 / math.sqrt(sum(c * c for c in across)))


def axes():
    along, across = chance.sample(AXES, 2)
    return scaled(along, chance.choice((-1, 1))), scaled(across, chance.choice((-1, 1)))


def some_width():
    return float(f"{chance.uniform(1, 10):.3g}e{chance.randrange(-6, 3)}")


def ten_to(power):
    return float(f"1e{power}")


def around(value):
    up, down = math.nextafter(value, math.inf), math.nextafter(value, 0)
    return value, up, down, math.nextafter(up, math.inf), math.nextafter(down, 0)


def line(directions, foot, height, length):
    """A branch whose line is at this height over its foot, which is at this distance from the start."""
    along, across = directions
    return plus(scaled(along, foot), scaled(across, height)), scaled(along, length)


def through_centre(name):
    for width in SHORT_WIDTHS + LONG_WIDTHS:
        for share in (0, 0.5, 1, 0.25, -0.5, 1.5):
            length = width * chance.choice((2.0**-20, 0.125, 1, 4, 64, 2.0**20))
            along = chance.choice((*AXES, *THIRDS, direction()))
            branch = scaled(along, length)
            yield width, scaled(branch, share), branch


def touching(name):
    for width in SHORT_WIDTHS + LONG_WIDTHS:
        support = SUPPORT[name] * width
        for height in (*around(support), support * (1 - 1e-12), support * (1 - 1e-6), support * (1 - 1e-3)):
            length = support * chance.choice((2.0**-7, 0.25, 1, 8, 2.0**13))
            yield width, *line(axes(), length * chance.choice((0, 0.5, 0.5, 0.25, 1)), height, length)
    for width in SHORT_WIDTHS:
        third = SUPPORT[name] * width / 3
        for towards in (None, math.inf, 0):
            along, across = chance.sample(THIRDS, 2)
            point, branch = line((along, across), third * chance.choice((0.5, 1, 2)), third, third * 4)
            if towards is not None:
                point = (*point[:2], math.nextafter(point[2], math.copysign(towards, point[2])))
            yield width, point, branch


def end_on_edge(name):
    for width in SHORT_WIDTHS[1::2] + LONG_WIDTHS[::2]:
        for steps, support in itertools.product(EDGE_STEPS, around(SUPPORT[name] * width)[:3]):
            turned = chance.choice(((0, 1, 2), (1, 2, 0), (2, 0, 1)))
            point = tuple((support, 0.0, 0.0)[i] for i in turned)
            branch = tuple(steps[i] * support for i in turned)
            if steps[0] < 4 and chance.random() < 0.5:  # 1 - 4 supports would be rounded
                point, branch = minus(point, branch), scaled(branch, -1)
            yield width, point, branch
    for width in SHORT_WIDTHS:
        along, across = chance.sample(THIRDS, 2)
        point = scaled(across, SUPPORT[name] * width / 3)
        branch = plus(scaled(along, width / 4), scaled(across, width * chance.choice((-0.25, 0.25))))
        yield width, point, branch
        yield width, minus(point, branch), scaled(branch, -1)


def long_branch(name):
    for power in range(1, 7):
        for directions in (frame(), frame(), frame(), axes(), axes()):
            width = some_width()
            length = width * ten_to(power)
            foot = length * chance.choice((0, 1, 0.5, chance.random())) + width * chance.uniform(-1.5, 1.5)
            yield width, *line(directions, foot, width * SUPPORT[name] * chance.uniform(0, 1.02), length)


def short_branch(name):
    for power in range(-12, -2):
        width = some_width()
        support = SUPPORT[name] * width
        length = width * ten_to(power)
        branch = scaled(direction(), length)
        yield width, scaled(direction(), support * chance.random()), branch
        yield width, scaled(direction(), length * chance.uniform(0, 2)), branch
        yield width, *line(frame(), length * chance.random(), support * chance.uniform(0.1, 0.9), length)
        outwards = direction()
        yield width, scaled(outwards, support + length * chance.uniform(-0.5, 0.5)), branch
        yield width, scaled(outwards, support + length * chance.random()), scaled(outwards, length)
        yield width, scaled(outwards, support - 2 * length), branch
        yield width, *line(axes(), length / 2, support - length * length / (8 * support), length)


def no_length(name):
    for width in (SHORT_WIDTHS[0], SHORT_WIDTHS[3], *LONG_WIDTHS[1:4]):
        support = SUPPORT[name] * width
        for distance in (0.0, width * 1e-12, support * 0.3, *around(support)[:3], support * 2):
            yield width, scaled(axes()[0], distance), (0.0, 0.0, 0.0)
        yield width, scaled(direction(), support * chance.random()), (0.0, 0.0, 0.0)
        yield width, scaled(THIRDS[1], support / 3), (0.0, 0.0, 0.0)


def vanishing_branch(name):
    for length in (1e-20, 1e-40, 1e-100, 1e-155, 1e-170, 1e-300, 5e-324):
        width = some_width()
        yield width, scaled(direction(), width * SUPPORT[name] * chance.uniform(0, 0.99)), scaled(axes()[0], length)
    yield 1.0, (1e-170, 0.0, 2e-170), (3e-170, 1e-170, 0.0)
    yield 1.0, (5e-324, 0.0, 0.0), (0.0, 5e-324, 0.0)


def tiny_component(name):
    for power in (-8, -12, -16, -20, -100, -170, -300, -320):
        for share in (0.5, chance.uniform(-0.1, 1.1)):
            width = some_width()
            along, across = axes()
            point, branch = line((along, across), 0.0, width * SUPPORT[name] * chance.uniform(0.1, 0.99), width * 2)
            branch = plus(branch, scaled(across, width * ten_to(power)))
            yield width, plus(point, scaled(branch, share)), branch


def far_tail(name):
    if name != "gaussian":
        return
    for gap in (0.5, 0.1, 0.01, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15):
        for length in (1e-9, 1e-3, 0.3, 2, 1e3):
            width = some_width()
            length *= width
            distance = width * (3 - gap)
            yield width, *line(frame(), length * chance.random(), distance, length)
            outwards = direction()
            yield width, scaled(outwards, distance), scaled(outwards, length * chance.choice((-1, 1)))


def near_kink(name):
    if name != "lucy":
        return
    for power in range(-12, -2):
        for length in (1e-12, 1e-9, 1e-6, 1e-3, 0.1, 1, 10, 1e3, 1e6):
            width = some_width()
            height = width * ten_to(power)
            length *= width
            yield width, *line(axes(), length * chance.choice((0.5, 0.3, chance.random())), height, length)
            # The start of a branch askew is close to the centre: rounding would spoil the height elsewhere.
            foot = height * chance.choice((0, 0.5, -1, 1, 10))
            yield width, *line(frame(), foot, height, length)


def along_axis(name):
    for _ in range(20):
        width = some_width()
        support = SUPPORT[name] * width
        length = support * chance.uniform(0.1, 3)
        yield width, *line(axes(), length * chance.uniform(-0.2, 1.2), support * chance.uniform(0, 1.05), length)


def anywhere(name):
    for _ in range(60):
        width = some_width()
        support = SUPPORT[name] * width
        length = support * chance.uniform(0.05, 4)
        yield width, *line(frame(), length * chance.uniform(-0.3, 1.3), support * chance.uniform(0, 1.05), length)


KINDS = (through_centre, touching, end_on_edge, long_branch, short_branch, no_length, vanishing_branch,
         tiny_component, far_tail, near_kink, along_axis, anywhere)


def main(path, checked):
    lines = []
    for name in SUPPORT:
        for width in (1e-6, 2.5e-4, 0.003, 0.1, 0.5, 1.0, math.pi, 42.0, 1000.0):
            value = norm(name, width)
            if checked:
                check(value / norm(name, 1), quadrature_norm(name, width) / norm(name, 1), name, width)
            lines.append(f"norm {name} {width.hex()} {nearest_double(value).hex()}")
    for kind in KINDS:
        count, zeros = 0, 0
        for name in SUPPORT:
            for width, point, branch in kind(name):
                value = line_mean(name, width, point, branch)
                if checked:
                    check(value, quadrature_mean(name, width, point, branch), kind.__name__, name, width, point, branch)
                lines.append(" ".join((name, *(c.hex() for c in (width, *point, *branch, nearest_double(value))))))
                count, zeros = count + 1, zeros + (value == 0)
        print(f"{kind.__name__}: {count} cases, {zeros} of them 0", flush=True)
    with open(path, "wb") as stream:
        stream.write(gzip.compress(("\n".join(lines) + "\n").encode(), 9, mtime=0))
    print(f"{len(lines)} lines")


if __name__ == "__main__":
    main(sys.argv[1], "--check" in sys.argv[2:])
