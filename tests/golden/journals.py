"""Writes journals.csv: linkages whose journals are rigid, from impact to impact.

    python3 tests/golden/journals.py > tests/golden/journals.csv

Bodies are a crank on a pin of the ground, or free but for journals: between impacts they fly along parabolas, and the crank swings as a pendulum, by
Taylor series of order 16.  A touch is the least root of |e| = c, to rounding.  An impact takes no time and goes by the impulse of the normal force: slip
goes on until it ends, then it sticks or turns round, as friction allows.  The rebound is that of a contact F = K d^n (1 + a d'/v0), a(1+e) =
ln[(1+a)/(1-ea)], in the limit of a large K: exactly e of the approach, unless the end of slip changes the mass that the contact feels.

Cases: `rod`, which falls and spins about a journal on the ground, and `four_bar`, with three journals (the proportions of Siconos' example
FourBarLinkage with 3 clearances: 1, 4 and 2.5 m, 3 m between the pins, 1 kg each), its crank free; each without friction and with 0.1.
"""

import math
from typing import NamedTuple

GRAVITY, RESTITUTION = 9.81, 0.9


class Body(NamedTuple):
    mass: float
    inertia: float  # about the mass centre
    center: float  # of mass, along the body's X from its origin


class Journal(NamedTuple):
    first: int  # body with the journal; -1: the ground
    first_x: float
    second: int  # body with the bearing
    second_x: float
    clearance: float
    radius: float  # of the bearing


class Case(NamedTuple):
    bodies: tuple
    journals: tuple
    has_crank: bool
    start: tuple  # angle and rate of each body; journals start amid their bearings, and as fast as these
    end: float
    samples: int


CASES = {
    "rod": Case((Body(1, 0.08, 0.3),), (Journal(0, 0, -1, 0, 1e-3, 0.02),), False, ((0.3, 2.0),), 0.12, 24),
    "four_bar": Case((Body(1, 1 / 12, 0.5), Body(1, 16 / 12, 2), Body(1, 6.25 / 12, 1.25)),
                     (Journal(0, 1, 1, 0, 5e-3, 0.06), Journal(1, 4, 2, 2.5, 5e-3, 0.06), Journal(2, 0, -1, 3, 5e-3, 0.06)), True,
                     ((math.pi / 2, 4.5 * math.pi),), 0.04, 20),
}


def four_bar_start(bodies, angle, rate):
    """Angles and rates of coupler and rocker that go with the crank's where pins have no clearance, coupler above."""
    coupler, rocker, apart = 4.0, 2.5, 3.0
    x, y = math.cos(angle) - apart, math.sin(angle)  # of the crank's pin from the post
    reach = math.hypot(x, y)
    third = math.atan2(y, x) - math.acos((reach**2 + rocker**2 - coupler**2) / (2 * reach * rocker))
    second = math.atan2(rocker * math.sin(third) - y, rocker * math.cos(third) - x)
    along = math.sin(second - third)
    return ((angle, rate), (second, rate * math.sin(third - angle) / (coupler * along)), (third, rate * math.sin(second - angle) / (rocker * along)))


class Linkage:
    """Coordinates: x, y and angle of each body's mass centre; those of a crank follow from its angle."""

    def __init__(self, case, friction):
        self.case, self.friction, self.time = case, friction, 0.0
        start = four_bar_start(case.bodies, *case.start[0]) if case.has_crank else case.start
        self.place, self.rate = [], []
        at, moves = (0.0, 0.0), (0.0, 0.0)
        for i, (body, (angle, spin)) in enumerate(zip(case.bodies, start)):
            if i == 2:  # from the coupler's end back to the post
                at, moves = (case.journals[2].second_x, 0.0), (0.0, 0.0)
            c, s = math.cos(angle), math.sin(angle)
            self.place.append([at[0] + body.center * c, at[1] + body.center * s, angle])
            self.rate.append([moves[0] - body.center * spin * s, moves[1] + body.center * spin * c, spin])
            if i == 0 and case.has_crank:
                at, moves = (c, s), (-spin * s, spin * c)
        self.swing = None

    def moved(self, time):
        """Places and rates a time after the last event; of the crank by its series."""
        places, rates = [], []
        for i, (p, v) in enumerate(zip(self.place, self.rate)):
            if i == 0 and self.case.has_crank:
                body = self.case.bodies[0]
                if self.swing is None:
                    self.swing = self.series(p[2], v[2], body.mass * GRAVITY * body.center / (body.inertia + body.mass * body.center**2))
                angle = sum(a * time**k for k, a in enumerate(self.swing))
                spin = sum(k * a * time ** (k - 1) for k, a in enumerate(self.swing) if k)
                c, s = math.cos(angle), math.sin(angle)
                places.append([body.center * c, body.center * s, angle])
                rates.append([-body.center * spin * s, body.center * spin * c, spin])
            else:
                places.append([p[0] + v[0] * time, p[1] + v[1] * time - GRAVITY / 2 * time**2, p[2] + v[2] * time])
                rates.append([v[0], v[1] - GRAVITY * time, v[2]])
        return places, rates

    @staticmethod
    def series(angle, spin, stiffness):
        """Taylor's coefficients of angle'' = -stiffness cos(angle)."""
        a, c, s = [angle, spin], [math.cos(angle)], [math.sin(angle)]
        for k in range(16):
            a.append(-stiffness * c[k] / ((k + 1) * (k + 2)))
            s.append(sum((j + 1) * a[j + 1] * c[k - j] for j in range(k + 1)) / (k + 1))
            c.append(-sum((j + 1) * a[j + 1] * s[k - j] for j in range(k + 1)) / (k + 1))
        return a

    def point(self, body, x, places, rates):
        """Arm from the mass centre to a point on a body's X, its place and velocity."""
        if body < 0:
            return (x, 0.0), (x, 0.0), (0.0, 0.0)
        p, v, arm = places[body], rates[body], x - self.case.bodies[body].center
        ax, ay = arm * math.cos(p[2]), arm * math.sin(p[2])
        return (ax, ay), (p[0] + ax, p[1] + ay), (v[0] - v[2] * ay, v[1] + v[2] * ax)

    def offset(self, journal, places, rates):
        """From the bearing's centre to the journal's, and how fast that changes."""
        _, a, va = self.point(journal.first, journal.first_x, places, rates)
        _, b, vb = self.point(journal.second, journal.second_x, places, rates)
        return (a[0] - b[0], a[1] - b[1]), (va[0] - vb[0], va[1] - vb[1])

    def row(self, body, arm, direction, sign):
        """How a body's rates enter the velocity of a point along a direction, and what its mobility makes of a unit impulse there."""
        if body < 0:
            return [0.0] * 3, [0.0] * 3
        of = self.case.bodies[body]
        row = [sign * direction[0], sign * direction[1], sign * (arm[0] * direction[1] - arm[1] * direction[0])]
        if body == 0 and self.case.has_crank:
            angle = self.place[0][2]
            about = row[2] + of.center * (row[1] * math.cos(angle) - row[0] * math.sin(angle))
            return [0.0, 0.0, about], [0.0, 0.0, about / (of.inertia + of.mass * of.center**2)]
        return row, [row[0] / of.mass, row[1] / of.mass, row[2] / of.inertia]

    def impact(self, journal):
        """Changes rates as a touch does; tells the approach and the rebound."""
        e, _ = self.offset(journal, self.place, self.rate)
        size = math.hypot(*e)
        n = (e[0] / size, e[1] / size)
        t = (-n[1], n[0])
        touch = []  # arms of both bodies to the point of the journal that is next to the bearing
        for body, x, reach in ((journal.first, journal.first_x, journal.radius - journal.clearance), (journal.second, journal.second_x, journal.radius)):
            arm, _, _ = self.point(body, x, self.place, self.rate)
            touch.append((body, (arm[0] + reach * n[0], arm[1] + reach * n[1])))
        rows = {}
        for name, direction in (("n", n), ("t", t)):
            rows[name] = [(body, *self.row(body, arm, direction, sign)) for (body, arm), sign in zip(touch, (1, -1))]

        def velocity(name):
            return sum(r * v for body, row, _ in rows[name] if body >= 0 for r, v in zip(row, self.rate[body]))

        def between(one, other):
            return sum(r * m for (_, row, _), (_, _, made) in zip(rows[one], rows[other]) for r, m in zip(row, made))

        nn, nt, tt = between("n", "n"), between("n", "t"), between("t", "t")
        v0, slip = velocity("n"), velocity("t")
        slope = damping(RESTITUTION) / v0

        def work(v):
            return v / slope - math.log1p(slope * v) / slope**2

        # The normal impulse p slows the approach by (nn + mu s nt) dp and slip by (nt + mu s tt) dp.
        normal, aside = 0.0, 0.0
        sign = math.copysign(1.0, slip)
        loss = self.friction * sign
        slowing, end = nn + loss * nt, -RESTITUTION * v0
        slipping = nt + loss * tt
        until = slip / slipping if self.friction > 0 and slip * slipping > 0 else math.inf
        if until * slowing < v0 - end:
            normal, aside = until, -loss * until
            at = v0 - until * slowing
            stored = (work(v0) - work(at)) / slowing
            loss = -nt / tt if abs(nt) <= self.friction * tt else -loss
            slowing = nn + loss * nt
            low, high = -(1 - 1e-15) / slope, 0.0
            if at < 0:
                high = at
            for _ in range(200):  # of the rebound at which what is stored is given back
                end = (low + high) / 2
                low, high = (end, high) if (work(end) - work(at)) / slowing > stored else (low, end)
            normal, aside = normal + (at - end) / slowing, aside - loss * (at - end) / slowing
        else:
            normal, aside = (v0 - end) / slowing, -loss * (v0 - end) / slowing
        for name, impulse in (("n", -normal), ("t", aside)):
            for body, _, made in rows[name]:
                if body >= 0:
                    self.rate[body] = [v + impulse * m for v, m in zip(self.rate[body], made)]
        if self.case.has_crank:
            angle, spin, center = self.place[0][2], self.rate[0][2], self.case.bodies[0].center
            self.rate[0][:2] = [-center * spin * math.sin(angle), center * spin * math.cos(angle)]
        return v0, velocity("n")

    def excess(self, journal, time):
        """|e|^2 - c^2 and its rate."""
        e, v = self.offset(journal, *self.moved(time))
        return e[0] ** 2 + e[1] ** 2 - journal.clearance**2, 2 * (e[0] * v[0] + e[1] * v[1])

    def advance(self, time):
        places, rates = self.moved(time)
        self.place, self.rate, self.swing = places, rates, None
        self.time += time

    def run_to(self, end):
        """Goes on; yields time, journal, approach and rebound of each impact."""
        step = 2e-5
        while self.time < end - 1e-15:
            length = min(step, end - self.time)
            first = None
            for i, journal in enumerate(self.case.journals):
                if self.excess(journal, length)[0] <= 0:
                    continue
                low, high = 0.0, length
                for _ in range(100):
                    middle = (low + high) / 2
                    low, high = (low, middle) if self.excess(journal, middle)[0] > 0 else (middle, high)
                if first is None or high < first[0]:
                    first = high, i
            if first is None:
                self.advance(length)
                continue
            # Where it touches already it moves outwards no more: an impact that took no time is not taken twice.
            self.advance(first[0])
            before, after = self.impact(self.case.journals[first[1]])
            yield self.time, first[1], before, after

    def energy(self):
        return sum(b.mass * (v[0] ** 2 + v[1] ** 2) / 2 + b.inertia * v[2] ** 2 / 2 + b.mass * GRAVITY * p[1]
                   for b, p, v in zip(self.case.bodies, self.place, self.rate))


def damping(e):
    """a of a (1 + e) = ln[(1 + a)/(1 - e a)].

    >>> a = damping(0.9)
    >>> abs(a * 1.9 - math.log((1 + a) / (1 - 0.9 * a))) < 1e-12
    True
    """
    low, high = 1e-6, (1 - 1e-12) / e
    for _ in range(200):
        a = (low + high) / 2
        low, high = (low, a) if math.log1p(a) - math.log1p(-e * a) > a * (1 + e) else (a, high)
    return a


def rows_of(name, friction, told=None):
    """Time, impacts before it, and x, y, angle of each body, at each sample."""
    case = CASES[name]
    linkage, impacts = Linkage(case, friction), 0
    for k in range(1, case.samples + 1):
        for event in linkage.run_to(case.end * k / case.samples):
            impacts += 1
            if told is not None:
                told.append(event)
        yield [case.end * k / case.samples, impacts, *(x for p in linkage.place for x in p)]


def main():
    print("journals,friction,time,impacts," + ",".join(f"{q}{i}" for i in (1, 2, 3) for q in ("x", "y", "angle")))
    for name, case in CASES.items():
        for friction in (0.0, 0.1):
            for row in rows_of(name, friction):
                print(len(case.journals), friction, *(repr(x) for x in row), *(["0"] * (11 - len(row))), sep=",")


if __name__ == "__main__":
    main()
