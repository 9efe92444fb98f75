"""Bytes that one evaluation must move between memory and processor, for each bubble.

A counted model, not a measurement: the sequence of loops of an accepted step of `fix foam/abm`
(scheme standard) with every array that a loop needs read once and every array that it makes written
once, neighbours found in cache.  A program that is limited by memory alone, and whose arrays are
beyond its caches, takes these bytes divided by the bandwidth: the floor.  Two loops fused into one
need less, arrays cleared beforehand, atomic additions or copies more.  What belongs to builds of
the neighbour list (some in a hundred evaluations) is not in it.

`python3 traffic.py` prints the table.
"""

from dataclasses import dataclass

# LAMMPS stores x, v, f as rows of three numbers, and memory moves whole rows: in 2D too.
# D stands for as many numbers as there are dimensions: columns of our own.
D = "D"


@dataclass
class Loop:
    name: str
    reads: dict      # array: numbers for each bubble
    writes: dict
    why: str


# ---- with gas exchange: `what` = foam ------------------------------------------------------------

PREDICT = Loop(
    "predict",
    reads={"x": 3, "v": 3, "v_before": D, "q": 1, "qdot": 1, "qdot_before": 1, "radius": 1,
           "x_listed": D, "radius_listed": 1},
    writes={"x": 3, "q": 1, "radius": 1, "x_start": D, "q_start": 1, "radius_start": 1},
    why="y* from the rates of this step and the one before; the start is kept, in case the step "
        "is refused; how far from the listed state?")
PAIR = Loop(
    "pair",
    reads={"x": 3, "radius": 1, "list": None},
    writes={"f": 3, "film": 1, "area": 1},
    why="springs and the sums over contacts, each pair listed at both of its bubbles, so that sums "
        "are written once and never added to from elsewhere")
CORRECT = Loop(
    "correct",
    reads={"x_start": D, "v": 3, "f": 3, "x": 3, "q_start": 1, "qdot": 1, "film": 1, "area": 1,
           "radius": 1, "radius_start": 1, "x_listed": D, "radius_listed": 1},
    writes={"x": 3, "q": 1, "radius": 1},
    why="rates at y*, the corrected state, its distance from the predicted one, all sums that "
        "judge it")
RATES = Loop(
    "rates",
    reads={"f": 3, "film": 1, "area": 1, "radius": 1, "v": 3, "qdot": 1},
    writes={"v": 3, "qdot": 1, "v_before": D, "qdot_before": 1},
    why="rates of the new state; those of the start become the ones before")

# ---- springs and integration alone: `what` = relax -----------------------------------------------

RELAX = [
    Loop("predict", reads={"x": 3, "v": 3, "v_before": D, "x_listed": D},
         writes={"x": 3, "x_start": D}, why="as above, without gas"),
    Loop("pair", reads={"x": 3, "radius": 1, "list": None}, writes={"f": 3}, why="springs"),
    Loop("correct", reads={"x_start": D, "v": 3, "f": 3, "x": 3, "x_listed": D}, writes={"x": 3},
         why="as above, without gas"),
    Loop("rates", reads={"f": 3, "v": 3}, writes={"v": 3, "v_before": D}, why="as above"),
]

LOOPS = {"foam": [PREDICT, PAIR, CORRECT, RATES], "relax": RELAX}

# bytes of a number in LAMMPS' arrays x, v, radius and in forces and sums; columns are double
WIDTHS = {"double": (8, 8), "mixed": (4, 8), "single": (4, 4)}
IN_LAMMPS = {"x", "v", "radius"}
SUMS = {"f", "film", "area"}


def bytes_of(loop, dim, neighbours, precision="double"):
    """Bytes read and written by one loop for each bubble.

    neighbours: listed pairs divided by bubbles; each pair stands in the rows of both its bubbles.
    """
    number, total = WIDTHS[precision]

    def width(array, count):
        if array == "list":
            return 4 + 4 * 2 * neighbours      # how many, and their indices
        numbers = dim if count == D else count
        return numbers * (number if array in IN_LAMMPS else total if array in SUMS else 8)

    return tuple(sum(width(*item) for item in arrays.items()) for arrays in (loop.reads,
                                                                             loop.writes))


def per_evaluation(what, dim, neighbours, rejected=0.0, precision="double"):
    """Bytes per bubble and evaluation; rejected: part of all evaluations that were rejected ones.

    An accepted step evaluates twice, at the predicted and at the corrected state; a rejected one
    predicts, evaluates and corrects.
    """
    predict, pair, correct, rates = (sum(bytes_of(loop, dim, neighbours, precision))
                                     for loop in LOOPS[what])
    accepted = predict + 2 * pair + correct + rates
    refused = predict + pair + correct
    return (1.0 - rejected) * accepted / 2 + rejected * refused


def main():
    for dim, neighbours in ((2, 2.7), (3, 5.2)):
        print(f"{dim}D, {neighbours} listed pairs per bubble, double precision: bytes per bubble")
        for loop in LOOPS["foam"]:
            read, written = bytes_of(loop, dim, neighbours)
            arrays = ", ".join(loop.reads) + " -> " + ", ".join(loop.writes)
            print(f"  {loop.name:8s} {read:6.0f} read {written:6.0f} written   {arrays}")
        print(f"  an evaluation: {per_evaluation('foam', dim, neighbours):.0f}")


if __name__ == "__main__":
    main()
