"""One packing: contacts without rattlers, moduli, the jamming point; from what in.jamming wrote."""
import collections
import csv
import itertools

import numpy as np

# residual: largest force left on a bubble, relative to the mean force of a contact; spare: contacts above d(N-1);
# shear_exact, bulk_exact: moduli by the second derivatives of the energy
Point = collections.namedtuple("Point", "distance phi phi_j pressure bulk bulk_exact shear shear_exact shear_every "
                               "excess excess_n rattlers spare residual")


def read_frames(path):
    """Of each frame of a dump: places, radii, edges of the box (which has no tilt there)."""
    lines = path.read_text().split("\n")
    at = 0
    while at + 9 < len(lines):
        n = int(lines[at + 3])
        bounds = np.array([line.split() for line in lines[at + 5:at + 8]], float)
        if np.any(bounds[:, 2:] != 0):
            raise SystemExit(f"{path}: the box has a tilt")
        rows = np.array([line.split() for line in lines[at + 9:at + 9 + n]], float)
        yield rows[:, 1:4], rows[:, 4], bounds[:, 1] - bounds[:, 0]
        at += 9 + n


def contacts(places, radii, edges, dim):
    """Pairs that overlap: their numbers, the vector from one to the other, and the sum of their radii."""
    pairs, apart = [], []
    for i in range(len(radii) - 1):
        vector = places[i + 1:, :dim] - places[i, :dim]
        vector -= edges[:dim] * np.round(vector / edges[:dim])
        near = np.flatnonzero((vector**2).sum(1) < (radii[i + 1:] + radii[i])**2)
        pairs.append(np.column_stack([np.full(len(near), i), near + i + 1]))
        apart.append(vector[near])
    pairs, apart = np.concatenate(pairs), np.concatenate(apart)
    return pairs, apart, radii[pairs].sum(1)


def without_rattlers(pairs, n, dim):
    """Which pairs are left when bubbles with fewer than dim+1 contacts are taken out until there are none."""
    keep = np.ones(len(pairs), bool)
    while True:
        number = np.bincount(pairs[keep].ravel(), minlength=n)
        loose = (number > 0) & (number <= dim)
        if not loose.any():
            return keep, np.count_nonzero(number)
        keep &= ~loose[pairs].any(1)


def exact_moduli(pairs, apart, sums, rin, alpha, volume):
    """Shear (xy) and bulk modulus at infinitesimal strain, and the pressure, by derivatives of the energy.

    With strain e, bubbles move with the box and, by u, relative to it, until they are at rest again:
    E'' = E_ee - E_eu (E_uu)^-1 E_ue. Pressure is in it, as in stress against strain of the box.
    """
    dim = apart.shape[1]
    distance = np.sqrt((apart**2).sum(1))
    normal = apart / distance[:, None]
    overlap = 1 - distance / sums
    force = rin * overlap**(alpha - 1)
    stiff = rin * (alpha - 1) * overlap**(alpha - 2) / sums
    along = normal[:, :, None] * normal[:, None, :]
    block = stiff[:, None, None] * along - (force / distance)[:, None, None] * (np.eye(dim) - along)

    numbers, pairs = np.unique(pairs, return_inverse=True)
    n, pairs = len(numbers), pairs.reshape(-1, 2)
    hessian = np.zeros((n, n, dim, dim))
    for a, b, sign in ((0, 0, 1), (1, 1, 1), (0, 1, -1), (1, 0, -1)):
        np.add.at(hessian, (pairs[:, a], pairs[:, b]), sign * block)
    hessian = hessian.transpose(0, 2, 1, 3).reshape(n * dim, n * dim)
    hessian += 1e-13 * np.trace(hessian) / (n * dim) * np.eye(n * dim)      # the packing as a whole stays where it is

    strains = [apart]                                # an expansion; then shear in all directions
    for a, b in itertools.combinations(range(dim), 2):
        strains += [np.zeros_like(apart), np.zeros_like(apart)]
        strains[-2][:, a] = apart[:, b]
        strains[-1][:, a], strains[-1][:, b] = apart[:, a] / 2, -apart[:, b] / 2
    push, second = np.zeros((len(strains), n, dim)), []
    for row, strain in zip(push, strains):
        pull = np.einsum("kij,kj->ki", block, strain)
        np.add.at(row, pairs[:, 0], -pull)
        np.add.at(row, pairs[:, 1], pull)
        second.append((strain * pull).sum())
    push = push.reshape(len(strains), -1)
    second = (np.array(second) - (push * np.linalg.solve(hessian, push.T).T).sum(1)) / volume
    pressure = (force * distance).sum() / (dim * volume)
    # lengths grow by 1+e: E' = -p dV/de, so E'' = -dp/de dV - p d(d-1) V, and the bulk modulus is -dp/de / d
    bulk = (second[0] + pressure * dim * (dim - 1)) / dim**2
    # stretched by 1+e/2 and 1-e/2 the box gets smaller by e^2/4, which is no shear. In 3D there are 5 shears: of the
    # three stretches one is what the two others make
    simple, stretch = second[1::2], second[2::2] - pressure / 2
    every = (simple.sum() + (1 if dim == 2 else 2 / 3) * stretch.sum()) / (2 if dim == 2 else 5)
    return simple[0], every, bulk, pressure


def read_packing(path, alpha, dim, converged):
    """Points of one packing, and how many were refused, since a force of more than `converged` was left."""
    with open(path, newline="") as f:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(f)]
    # phi_J: pressure^(1/(alpha-1)) of the two points next to it goes to zero linearly
    root = [row["pressure"]**(1 / (alpha - 1)) for row in rows[:2]]
    phi_j = rows[0]["phi"] - root[0] * (rows[1]["phi"] - rows[0]["phi"]) / (root[1] - root[0])
    if abs(rows[0]["phi"] - phi_j - rows[0]["distance"]) > 0.5 * rows[0]["distance"]:
        phi_j = rows[0]["phi"] - rows[0]["distance"]    # it gave way between the two: as in.jamming found it
    points, refused = [], 0
    for row, (places, radii, edges) in zip(rows, read_frames(path.with_suffix(".lammpstrj"))):
        rin = (radii.min() + radii.max()) / 2           # as in.jamming has it
        pairs, apart, sums = contacts(places, radii, edges, dim)
        keep, n = without_rattlers(pairs, len(radii), dim)
        pairs, apart, sums = pairs[keep], apart[keep], sums[keep]
        force = (rin * (1 - np.sqrt((apart**2).sum(1)) / sums)**(alpha - 1)).mean()
        if not row["residual"] < converged * force:
            refused += 1
            continue
        shear, every, bulk, pressure = exact_moduli(pairs, apart, sums, rin, alpha, np.prod(edges[:dim]))
        if abs(pressure / row["pressure"] - 1) > 1e-6:
            raise SystemExit(f"{path}: the contacts found give another pressure than LAMMPS")
        z = 2 * len(pairs) / n
        points.append(Point(
            row["distance"], row["phi"], phi_j, row["pressure"],
            row["phi"] * (row["pressure_more"] - row["pressure"]) / (row["phi_more"] - row["phi"]), bulk,
            (row["stress_up"] - row["stress_down"]) / (2 * row["strain"]), shear, every,
            z - 2 * dim, z - 2 * dim * (1 - 1 / n), 1 - n / len(radii), len(pairs) - dim * (n - 1),
            row["residual"] / force))
    return points, refused
