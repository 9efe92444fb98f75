"""What a run would write: tables, dumps; and the command lammps-foam."""

def dump_text(frames, columns, *, box=((0, 10), (0, 10), (-0.5, 0.5)), tilt=None, boundary="pp pp pp", times=None):
    """A dump of LAMMPS. `frames`: pairs (step, rows); `box` as LAMMPS writes it, bounds of the tilted box included."""
    text = []
    for number, (step, rows) in enumerate(frames):
        if times is not None:
            text += ["ITEM: TIME", repr(float(times[number]))]
        text += ["ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", str(len(rows)),
                 f"ITEM: BOX BOUNDS {'' if tilt is None else 'xy xz yz '}{boundary}"]
        for axis, (lo, hi) in enumerate(box):
            text.append(f"{lo!r} {hi!r}" + ("" if tilt is None else f" {tilt[axis]!r}"))
        text.append("ITEM: ATOMS " + " ".join(columns))
        text += [" ".join(repr(float(value)) if column != "id" else str(int(value))
                          for column, value in zip(columns, row)) for row in rows]
    return "\n".join(text) + "\n"


def write_series(path, **columns):
    """A series.csv."""
    lines = [",".join(columns)] + [",".join(repr(float(value)) for value in row) for row in zip(*columns.values())]
    path.write_text("\n".join(lines) + "\n")
    return path


def lammps_foam(*arguments):
    """The exit status of lammps-foam with these arguments; a message of an error is raised as SystemExit."""
    from lammps_foam.command import WORDS

    word, *rest = map(str, arguments)
    return WORDS[word](rest)
