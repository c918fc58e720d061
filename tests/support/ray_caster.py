# SPDX-License-Identifier: BSD-3-Clause
"""Particles as they are seen, in double precision: for each pixel the depth of the surface and its normal, by nothing of the library."""
import numpy


class Camera:
    """What leads from places to pixels, of a camera of VTK and a picture of some width and height."""

    def __init__(self, camera, width, height):
        self.width, self.height = width, height
        self.near, self.far = camera.GetClippingRange()
        self.parallel = bool(camera.GetParallelProjection())
        self.position = numpy.array(camera.GetPosition())
        to = numpy.array(camera.GetFocalPoint()) - self.position
        to /= numpy.linalg.norm(to)
        right = numpy.cross(to, camera.GetViewUp())
        right /= numpy.linalg.norm(right)
        self.axes = numpy.array([right, numpy.cross(right, to), -to])  # x y z of the camera
        self.half = camera.GetParallelScale() if self.parallel else numpy.tan(numpy.radians(camera.GetViewAngle()) / 2)

    def places(self, points):
        return (numpy.asarray(points, float) - self.position) @ self.axes.T

    def rays(self):
        """Origins and directions of the rays through the centres of all pixels, from the lower left, shape (height, width, 3)."""
        x = ((numpy.arange(self.width) + 0.5) / self.width * 2 - 1) * self.half * self.width / self.height
        y = ((numpy.arange(self.height) + 0.5) / self.height * 2 - 1) * self.half
        x, y = numpy.meshgrid(x, y)
        zero = numpy.zeros_like(x)
        if self.parallel:
            return numpy.stack([x, y, zero], -1), numpy.broadcast_to([0., 0., -1.], x.shape + (3,))
        return numpy.stack([zero, zero, zero], -1), numpy.stack([x, y, zero - 1], -1)

    def window(self, centre, radius):
        """The rows and columns of the pixels whose rays may meet a sphere."""
        x, y, away = centre[0], centre[1], -centre[2]
        if not self.parallel and away <= 1.01 * radius:
            return slice(0, 0 if away < -radius else self.height), slice(0, self.width)
        ratio = 0 if self.parallel else radius / away
        at = numpy.array([x, y]) / (1 if self.parallel else away)
        size = radius / (1 if self.parallel else away) * numpy.sqrt(1 + (0 if self.parallel else at**2 - ratio**2)) / (1 - ratio**2)
        full = self.half * numpy.array([self.width / self.height, 1])
        ends = ((at / (1 - ratio**2) + numpy.array([[-1], [1]]) * size) / full + 1) / 2 * [self.width, self.height]
        low, high = numpy.clip(ends, -1, [self.width + 1, self.height + 1]).astype(int)
        return tuple(slice(max(0, low[k] - 1), max(0, high[k] + 2)) for k in (1, 0))

    def depth(self, z):
        """What is in the depth buffer, from 0 to 1, for z of the camera."""
        n, f = self.near, self.far
        return (-z - n) / (f - n) if self.parallel else f * (-z - n) / ((f - n) * -z)


def turn_of(quaternion):
    """The matrix that a quaternion w x y z stands for."""
    w, x, y, z = numpy.asarray(quaternion, float) / numpy.linalg.norm(quaternion)
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def _gradient(p, n1, n2):
    """What points away from the superquadric through a place, of no certain length."""
    a = numpy.abs(p)
    b = a / numpy.maximum(a.max(-1), 1e-300)[..., None]
    across = b[..., 0] ** n2 + b[..., 1] ** n2
    with numpy.errstate(divide="ignore", invalid="ignore"):
        outer = numpy.where(across > 0, across ** (n1 / n2 - 1), 0)
    return numpy.sign(p) * numpy.stack([outer * b[..., 0] ** (n2 - 1), outer * b[..., 1] ** (n2 - 1), b[..., 2] ** (n1 - 1)], -1)


def _within(p, n1, n2):
    """Whether places are in the superquadric."""
    a = numpy.abs(p)
    return (a[..., 0] ** n2 + a[..., 1] ** n2) ** (n1 / n2) + a[..., 2] ** n1 <= 1


def _halve(low, high, is_low, times):
    """The middle of what remains where is_low says which half of an interval to go on with."""
    for _ in range(times):
        half = (low + high) / 2
        up = is_low(half)
        low, high = numpy.where(up, half, low), numpy.where(up, high, half)
    return (low + high) / 2


def _meet(origin, along, n1, n2):
    """The parameters where rays enter and leave a superquadric, NaN where they miss it: by bisection."""
    centre = -(origin * along).sum(-1) / (along * along).sum(-1)
    reach = 4 / numpy.sqrt((along * along).sum(-1))
    at = lambda t: origin + t[..., None] * along
    # the norm whose unit ball is the superquadric is convex along the ray: where it is least its slope changes sign
    middle = _halve(centre - reach, centre + reach, lambda t: (_gradient(at(t), n1, n2) * along).sum(-1) < 0, 60)
    hit = _within(at(middle), n1, n2)
    return [numpy.where(hit, _halve(middle, centre + sign * reach, lambda t: _within(at(t), n1, n2), 60), numpy.nan) for sign in (-1, 1)]


def cast(camera, points, axes, quaternions=None, powers=None, clip=None):
    """Returns depth, normal in the camera's axes and number of the particle of each pixel; depth 1 and number -1 where there is none.

    axes    half axes, shape (n, 3)
    powers  n1, n2 of each
    clip    returns True for places, in the camera's axes, that are seen
    """
    origins, alongs = camera.rays()
    bests = numpy.full(origins.shape[:2], numpy.inf)
    normals, numbers = numpy.zeros(origins.shape), numpy.full(origins.shape[:2], -1)
    for i, centre in enumerate(camera.places(points)):
        window = camera.window(centre, numpy.linalg.norm(axes[i]) if powers is not None else max(axes[i]))
        origin, along = origins[window], alongs[window]
        best, normal, number = bests[window], normals[window], numbers[window]  # views
        turn = camera.axes @ (numpy.eye(3) if quaternions is None else turn_of(quaternions[i]))
        n1, n2 = (2, 2) if powers is None else powers[i]
        o, d = (origin - centre) @ turn / axes[i], along @ turn / axes[i]
        if n1 == n2 == 2:
            a, b = (d * d).sum(-1), (o * d).sum(-1)
            closest = o - (b / a)[..., None] * d
            with numpy.errstate(invalid="ignore"):
                root = numpy.sqrt((1 - (closest * closest).sum(-1)) / a)
            ends = [-b / a - root, -b / a + root]
        else:
            near = (o * o).sum(-1) - (o * d).sum(-1)**2 / (d * d).sum(-1) <= 3.01
            ends = [numpy.full(near.shape, numpy.nan), numpy.full(near.shape, numpy.nan)]
            if near.any():
                for end, found in zip(ends, _meet(o[near], d[near], n1, n2)):
                    end[near] = found
        done = numpy.zeros(best.shape, bool)
        for side, t in zip((1, -1), ends):
            place = origin + t[..., None] * along
            with numpy.errstate(invalid="ignore"):
                seen = (place[..., 2] <= -camera.near) & ~done
                if clip is not None:
                    seen &= clip(place)
                done |= seen
                nearer = seen & (-place[..., 2] < best) & (-place[..., 2] <= camera.far)
            best[nearer] = -place[nearer][:, 2]
            number[nearer] = i
            outward = _gradient((o + t[..., None] * d)[nearer], n1, n2) / axes[i] @ turn.T
            normal[nearer] = side * outward / numpy.linalg.norm(outward, axis=-1, keepdims=True)
    depth = numpy.where(numbers >= 0, camera.depth(-numpy.where(numbers >= 0, bests, camera.near)), 1)
    return depth, normals, numbers
