"""Small problems whose solution is known: two bubbles, and bubbles that do not touch."""

import numpy as np
import pytest

from runner import HEAD, PRECISE, data_file


def last(lmp, dim, x, R, box, pair, fixes, run, every=None):
    """The frame at the end of a run, and its time."""
    frame = lmp(HEAD.format(dim=dim) + f"""
read_data     data
{pair}
{fixes}
thermo        1000000
dump          d all custom {every or run} dump id xu yu zu radius vx vy vz
dump_modify   d sort id time yes format float %.17g
run           {run}
""", files={"data": data_file(box, x, R)}).dump("dump")[-1]
    return frame, frame.time


def fixed(integrator, t, n):
    """An integrator for n steps of equal length up to t; the tolerance never matters."""
    style, *keywords = integrator.split()
    return (f"fix step all foam/{style} 1e9 dt0 {t / n:.17g} dtmax {t / n:.17g} "
            + " ".join(keywords))


def order(coarse, fine, ratio):
    return np.log(coarse / fine) / np.log(ratio)


# ---- two bubbles with film exchange only --------------------------------------------------------

def film_rate(dim, q, r, K):
    """d(R^d)/dt of bubble 1; bubble 2 has the rest of q = R1^d, R2^d."""
    R1, R2 = (value**(1 / dim) for value in q)
    small = min(R1, R2)
    if r * r <= abs(R1**2 - R2**2):
        h2 = small**2
    else:
        a = (r * r + R2**2 - R1**2) / (2 * r)
        h2 = R2**2 - a * a
    area, ball = (2 * h2**0.5, np.pi) if dim == 2 else (np.pi * h2, 4 * np.pi / 3)
    return K * area * (1 / R2 - 1 / R1) / ball


def film_solution(dim, R, r, K, t, n):
    """Radii at time t by the classical Runge-Kutta method of order 4 with n steps."""
    q1, total, h = R[0]**dim, R[0]**dim + R[1]**dim, t / n

    def f(q):
        return film_rate(dim, (q, total - q), r, K)

    for _ in range(n):
        k1 = f(q1)
        k2 = f(q1 + 0.5 * h * k1)
        k3 = f(q1 + 0.5 * h * k2)
        k4 = f(q1 + h * k3)
        q1 += h * (k1 + 2 * k2 + 2 * k3 + k4) / 6
    return np.array([q1, total - q1])**(1 / dim)


DISTANCE = {"lens": 1.7,
            "passing": 0.92,    # the lens plane passes the centre of the smaller one on the way
            "swallowed": 0.3, "coincident": 0.0}


@pytest.mark.parametrize("integrator, case", [("abm", case) for case in DISTANCE] +
                         [("rkc", "passing"), ("rkc stages 7", "lens")])
@pytest.mark.parametrize("dim", [2, 3])
def test_film_exchange_of_two_bubbles(lmp, dim, integrator, case):
    r, R, K, t = DISTANCE[case], np.array([1.2, 0.8]), 0.5, 1.0
    exact = film_solution(dim, R, r, K, t, 4000)
    # order 4 with such steps: good to 1e-12, as another number of steps shows
    assert np.allclose(exact, film_solution(dim, R, r, K, t, 3000), rtol=0, atol=1e-12)
    passed = (r * r < exact[0]**2 - exact[1]**2) != (r * r < R[0]**2 - R[1]**2)
    assert passed == (case == "passing")

    x = np.full((2, dim), 5.0)
    x[1, 0] += r

    def error(n):
        frame, end = last(lmp, dim, x, R, [12.0] * dim,
                          "pair_style durian/foam 1.0\npair_coeff * * 0.0",
                          f"fix gas all foam/coarsen {K} 0.0 rmin 0\n" +
                          fixed(integrator, t, n), n)
        assert end == pytest.approx(t, rel=1e-12)
        assert np.array_equal(frame.array(*["xu", "yu", "zu"][:dim]), x)    # without springs
        return np.max(np.abs(frame["radius"] - exact))

    n = 1000 if integrator == "abm" else 100    # 1e5 stages round off to 1e-13
    coarse, fine = error(n), error(16 * n)
    assert fine < 1e-8
    assert order(coarse, fine, 16) == pytest.approx(2, abs=0.05)


# ---- two bubbles with a spring only -------------------------------------------------------------

@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("integrator, r", [("abm", 1.3), ("abm", 0.0), ("rkc stages 7", 1.3)])
def test_spring_of_two_bubbles(lmp, dim, integrator, r):
    """Radii stay; d(overlap)/dt = -2 sigma0 <R_in> / (mu0 (R_i + R_j)) overlap."""
    sigma0, mu0, rin, t = 3.0, 2.0, 0.7, 1.5
    R = np.array([1.2, 0.8])
    direction = np.array([2.0, -1.0, 2.0])[:dim]
    direction /= np.linalg.norm(direction)
    if r == 0.0:
        direction = np.eye(dim)[0]    # coincident bubbles part along x
    x = np.full((2, dim), 5.0)
    x[1] += r * direction

    rate = 2 * sigma0 * rin / (mu0 * R.sum())
    overlap = (R.sum() - r) * np.exp(-rate * t)

    def run(n):
        frame, end = last(lmp, dim, x, R, [12.0] * dim,
                          f"pair_style durian/foam {mu0} rin {rin}\npair_coeff * * {sigma0}",
                          fixed(integrator, t, n), n)
        assert end == pytest.approx(t, rel=1e-12)
        return frame

    def error(frame):
        centre = frame.array(*["xu", "yu", "zu"][:dim])
        assert np.allclose(centre.sum(axis=0), x.sum(axis=0), rtol=0, atol=1e-12)
        # coincident bubbles part in one of two opposite directions: measure the distance
        return abs(R.sum() - overlap - np.linalg.norm(centre[1] - centre[0]))

    coarse, frame = error(run(1000)), run(20000)
    assert error(frame) < 1e-8
    assert order(coarse, error(frame), 20) == pytest.approx(2, abs=0.05)

    assert np.array_equal(frame["radius"], R)
    # the velocities are those of the state: half the rate of the distance each
    v = frame.array(*["vx", "vy", "vz"][:dim])
    sign = np.sign((frame["xu"][1] - frame["xu"][0]) * direction[0])
    assert np.allclose(v[1], sign * 0.5 * rate * overlap * direction, rtol=0, atol=2e-8)
    assert np.allclose(v[0], -v[1], rtol=0, atol=1e-15)


@pytest.mark.parametrize("style", ["abm", "rkc"])
def test_spring_by_tolerance(lmp, style):
    """The same through step control: the error of the path falls as tolerance^(2/3)."""
    def error(tolerance):
        frame, t = last(lmp, 2, [[5.0, 5.0], [6.3, 5.0]], [1.2, 0.8], [12.0, 12.0],
                        "pair_style durian/foam 1.0\npair_coeff * * 1.0",
                        f"fix step all foam/{style} {tolerance:g} dt0 1e-4\n"
                        "variable past equal time>1\n"
                        "fix end all halt 1 v_past > 0 error soft message no", 100000, every=1)
        return abs((frame["xu"][1] - frame["xu"][0]) - (2 - 0.7 * np.exp(-t)))

    coarse, fine = error(1e-5), error(1e-8)
    assert fine < 2e-6
    assert np.log10(coarse / fine) / 3 == pytest.approx(2 / 3, abs=0.05)


# ---- bubbles that do not touch ------------------------------------------------------------------

# With free bubbles only, both laws reduce to dR/dt = c(t) (1/rho - 1/R) g(R), for which the method
# of Lifshitz, Slyozov and Wagner gives the distribution that keeps its shape. With z = R / rho,
# the share Q(z) of bubbles larger than z, up to a factor, and the growth from <R_in> are
#
#   area 2D  Q = (2 - z)^-2 exp(-4 / (2 - z))                           <R>^3 = 1 + 3/4 kappa tau
#   area 3D  Q = (2 - z)^-3 exp(-6 / (2 - z))                           <R>^4 = 1 + <z>^2 kappa tau
#   lsw 3D   Q = (z + 3)^(-4/3) (3/2 - z)^(-5/3) exp(-3 / (3 - 2 z))    <R>^3 = 1 + 4/9 kappa tau
#
# (lengths in <R_in>). A foam that starts with this distribution follows its power law from the
# start: nothing has to be waited for, and radii taken at equal shares of Q make it free of the
# noise that random radii would have.

FREE = {
    "area 2D": (2, 2.0, lambda z: (2 - z)**-2 * np.exp(-4 / (2 - z)),
                3, lambda mean: 3 / 4),
    "area 3D": (3, 2.0, lambda z: (2 - z)**-3 * np.exp(-6 / (2 - z)),
                4, lambda mean: mean**2),
    "lsw 3D": (3, 1.5, lambda z: (z + 3)**(-4 / 3) * (1.5 - z)**(-5 / 3) * np.exp(-3 / (3 - 2 * z)),
               3, lambda mean: 4 / 9),
}


@pytest.mark.parametrize("style, law", [("abm", law) for law in FREE] + [("rkc", "lsw 3D")])
def test_growth_of_free_bubbles(lmp, style, law):
    dim, largest, share, power, constant = FREE[law]
    z = np.linspace(0, largest, 200001)[:-1]
    Q = share(z) / share(0.0)
    mean = np.sum(Q) * (z[1] - z[0])    # <z> is the integral of Q
    n = 4096
    R = np.interp((np.arange(n) + 0.5) / n, Q[::-1], z[::-1])
    R /= np.mean(R)

    # 4096 = 64^2 = 16^3 sites, so far apart that the largest at the end, R = 7.5, do not touch
    spacing, sites = 16.0, round(n**(1 / dim))
    axis = (np.arange(sites) + 0.5) * spacing
    x = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1).reshape(-1, dim)

    kappa = 0.5
    # until one in 20 (2D) or 40 (3D) is left, which is a factor of 4.4 or 3.4 in <R>
    table = lmp(HEAD.format(dim=dim) + f"""
read_data     data
pair_style    durian/foam 1.0
pair_coeff    * * 0.0
fix           gas all foam/coarsen 1.0 {kappa} liquid {law[:4]} rmin 0 nmin {n // (20 * (dim - 1))}
fix           step all foam/{style} 1e-2 norm rms dt0 1e-3
compute       b all foam/bubble contacts
compute       contacts all reduce max c_b
thermo        10
thermo_style  custom step f_gas[1] f_gas[2] f_gas[3] c_contacts
{PRECISE}
run           100000
""", files={"data": data_file([sites * spacing] * dim, x, R)}).thermo[0]
    tau, N, R = table["f_gas[1]"], table["f_gas[2]"], table["f_gas[3]"]
    assert np.max(table["c_contacts"]) == 0
    assert R[-1] > 3

    # The tolerance, 1e-2 for the error of a step, costs 0.5 % in <R>; ten times less costs 0.05 %.
    # N is discrete: 100 to 200 are left.
    a = constant(mean) * kappa
    assert np.max(np.abs(R / (1 + a * tau)**(1 / power) - 1)) < 0.01
    assert np.max(np.abs(N / n * (1 + a * tau)**(dim / power) - 1)) < 0.04

    # the exponent by a fit over the later part, time counted from where the law has <R> = 0
    late = R > 1.5
    exponent = np.polyfit(np.log(tau + 1 / a)[late], np.log(R)[late], 1)[0]
    assert exponent == pytest.approx(1 / power, abs=0.005)


# ---- forces of other fixes that depend on time --------------------------------------------------

@pytest.mark.parametrize("integrator", ["abm", "rkc", "rkc stages 7"])
def test_time_of_stages(lmp, integrator):
    """x' = t, in steps that grow: both methods are of order 2, and so exact."""
    frame, t = last(lmp, 2, [[5, 5]], [1.0], [1000.0] * 2,
                    "pair_style durian/foam 1.0\npair_coeff * * 1.0",
                    f"variable f equal time\nfix f all addforce v_f 0 0\n"
                    f"fix step all foam/{integrator.replace(' ', ' 1e9 ', 1)}"
                    f"{'' if ' ' in integrator else ' 1e9'} dt0 0.01 growth 1.3", 20)
    assert t > 1
    assert frame["xu"][0] == pytest.approx(5 + t**2 / 2, rel=1e-13)
    assert frame["vx"][0] == pytest.approx(t, rel=1e-13)


@pytest.mark.parametrize("integrator", ["abm", "rkc", "rkc stages 7"])
def test_two_bubbles_shaken(lmp, integrator):
    """The overlap u of two bubbles, of relaxation rate 1, under a force of 0.1 sin t that pulls at both:
    u' = - u - 0.2 sin t.  Order 2 in the step: 2.16 is measured for abm, whose first step is Euler's, and 1.98
    for rkc."""
    R, t = np.array([1.2, 0.8]), 1.0
    exact = (0.3 - 0.1) * np.exp(-t) - 0.1 * (np.sin(t) - np.cos(t))
    errors = []
    for n in (50, 100):
        frame, end = last(lmp, 2, [[5, 5], [6.7, 5]], R, [12.0] * 2,
                          "pair_style durian/foam 1.0\npair_coeff * * 1.0", f"""
group one id 1
group two id 2
variable f equal 0.1*sin(time)
variable g equal -v_f
fix f two addforce v_f 0 0
fix g one addforce v_g 0 0
{fixed(integrator, t, n)}""", n)
        assert end == pytest.approx(t, rel=1e-12)
        errors.append(abs(2.0 - np.ptp(frame["xu"]) - exact))
    assert errors[0] < 1e-3
    assert order(*errors, 2) == pytest.approx(2, abs=0.3)
