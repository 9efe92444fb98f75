"""Write the LAMMPS input that an input of the thesis' program means, and the one that goes on from a restart file.

The input has sections with headings. A run that goes on takes the same input, with its own beginning in the place of
the sections that make the foam: so what the user has changed in it stays.
"""

from __future__ import annotations

import re

from .thesis_input import Foam, Unusable

# of series.csv; lengths in units of <R_in>
COLUMNS = {
    "step": "$(step)", "time": "$(time:%.15g)", "tau": "$(f_gas[1]:%.10g)", "N": "$(f_gas[2]:%.0f)",
    "R": "$(f_gas[3]:%.10g)", "Rmax": "$(f_gas[4]:%.10g)", "phi": "$(f_gas[5]:%.12g)", "energy": "$(pe:%.12g)",
    "path": "$(v_path:%.10g)", "msd": "$(v_msd:%.10g)", "vvar": "$(v_vvar:%.10g)", "edurian": "$(c_edurian:%.12g)",
    "h": "$(f_step[2]:%.6g)",
}
SECTIONS = ("settings", "start", "mechanics", "relaxation", "coarsening", "tables", "run", "end")


def heading(section: str) -> str:
    return f"# ---------------- {section} ".ljust(96, "-")


def aligned(text: str) -> str:
    """Arguments of commands in one column; other lines, such as those that go on, stay as they are."""
    return re.sub(r"^([a-z_]+) +(?=\S)", lambda match: f"{match[1]:13s} ", text, flags=re.M)


def number(value: float) -> str:
    """The shortest text that is the same number; LAMMPS reads it back to the last bit."""
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


# ---- a new run ------------------------------------------------------------------------------------------------------

def new_run(foam: Foam, source: str, integrator: str = "abm", tolerance: float | None = None,
            gzip: bool = False, save: float = 600.0, save_steps: int | None = None) -> str:
    """The text of in.foam.

    tolerance: None for that of the input; save: seconds between restart files, or save_steps: steps between them.
    """
    parts = {
        "settings": _settings(foam, integrator, tolerance, save, save_steps),
        "start": _start(foam),
        "mechanics": _mechanics(foam),
        "relaxation": _relaxation(foam, integrator),
        "coarsening": _coarsening(foam, integrator),
        "tables": _tables("file", ",".join(COLUMNS), "no", "yes"),
        "run": _run(foam, gzip, save_steps is None),
        "end": _end(foam),
    }
    text = f"# A wet foam, written by lammps-foam run from {source} ({foam.form} form):\n#   lmp -in in.foam\n"
    text += "# goes on after an interruption by: lammps-foam resume DIRECTORY\n"
    for note in foam.notes:
        text += f"# {note}\n"
    for section in SECTIONS:
        text += f"\n{heading(section)}\n\n{aligned(parts[section])}"
    return text


def _variables(rows: list[tuple[str, str, str]]) -> str:
    return "".join(f"variable {name:9s} index {value:10s} # {text}\n" for name, value, text in rows)


def _settings(foam: Foam, integrator: str, tolerance: float | None, save: float,
              save_steps: int | None) -> str:
    abm = integrator == "abm"
    tolerance = foam.tolerance if tolerance is None else tolerance
    limit = foam.max_delta_energy * foam.K / foam.mean**2
    rows = [
        ("N", str(foam.bubbles), "bubbles at the start"),
        ("end", str(foam.end), "the run ends when no more are left"),
        ("seed", str(foam.seed), "of the random numbers"),
        ("mean", number(foam.mean), "radii at the start: mean and"),
        ("std", number(foam.std), "standard deviation (Gaussian),"),
        ("rmin", "0.1", "none below rmin * mean; smaller ones vanish in the run"),
        ("phi", number(foam.phi), "gas fraction; overlaps count twice"),
        ("sigma", number(foam.sigma), "spring constant"),
        ("mu", number(foam.mu), "drag coefficient"),
        ("K", number(foam.K), "gas exchange through films"),
        ("kappa", number(foam.kappa), "gas exchange through the liquid, relative to films"),
        ("tol", number(tolerance), "error of a step, " + ("largest of all bubbles" if abm else "root mean square")),
        ("dt0", number(foam.first_step), "first step"),
        ("nrelax", str(foam.relax_steps if abm else 50), "steps in a round of relaxation"),
        ("rounds", "500", "at most so many rounds"),
        ("limit", number(limit), "and fewer, once the energy changes by so little in a unit of time"),
        ("every", "50" if abm else "2", "steps between lines of series.csv"),
        ("report", "1000" if abm else "50", "steps between lines of the log"),
        ("save", number(save) if save_steps is None else str(save_steps),
         f"{'seconds' if save_steps is None else 'steps'} between restart files"),
    ]
    if foam.frequency > 0:
        rows.append(("frequency", number(foam.frequency), "snapshots per unit of tau = K t / <R_in>^2"))
    if any(foam.walls):
        rows.append(("walldrag", number(foam.wall_drag), "share of their velocity that bubbles lose along a wall"))
    text = _variables(rows)
    if not abm:
        text += (f"\n# The input's rounds of {foam.relax_steps} steps and its tolerance {number(foam.tolerance)} are "
                 "those of the predictor-corrector;\n# the steps of foam/rkc are longer, and so their rounds are "
                 "shorter.\n")
    return text


def _start(foam: Foam) -> str:
    box = " ".join(map(number, foam.sides[:foam.dimension]))
    boundary = " ".join("f" if wall else "p" for wall in foam.walls)
    return f"""units     lj
dimension {foam.dimension}
boundary  {boundary}{'':15s} # f: a wall, p: periodic
atom_style sphere 1             # radii change, and are communicated
create_foam ${{N}} ${{seed}} start grid box {box} sizes normal ${{mean}} ${{std}} rmin ${{rmin}}
"""


def _mechanics(foam: Foam) -> str:
    text = """pair_style durian/foam ${mu} drag static rin ${mean}    # <R_in>: the mean that was asked for
pair_coeff * * ${sigma}
neighbor  $(0.5*v_mean) bin
"""
    if any(foam.walls):
        faces = " ".join(f"{axis}lo {axis}hi" for axis, wall in zip("xyz", foam.walls) if wall)
        text += f"fix       walls all foam/wall {faces} drag ${{walldrag}}\n"
        text += "fix_modify walls energy yes virial yes    # pe and pressure are those of walls, too\n"
    return text


def _integrator(integrator: str) -> str:
    return "foam/abm ${tol} norm max" if integrator == "abm" else "foam/rkc ${tol} norm rms"


def _relaxation(foam: Foam, integrator: str) -> str:
    return f"""timestep  ${{dt0}}
fix       step all {_integrator(integrator)}
thermo    ${{nrelax}}
thermo_style custom step time pe f_step[2] f_step[5] cpu
thermo_modify norm no flush yes colname f_step[2] h colname f_step[5] evals
relax_foam phi ${{phi}} steps ${{nrelax}} rounds ${{rounds}} limit ${{limit}}
unfix     step
thermo_style one
reset_timestep 0 time 0.0
write_restart restart.*          # the relaxed foam
"""


def _coarsening(foam: Foam, integrator: str) -> str:
    text = f"""fix       step all {_integrator(integrator)} path yes
fix       gas all foam/coarsen ${{K}} ${{kappa}} rmin ${{rmin}} nmin ${{end}}
"""
    if foam.flow:
        text += _flow(foam)
    text += """
# averages over bubbles: lengths of paths, squares of displacements, velocities
variable  rin equal f_gas[9]
compute   d all displace/atom
variable  dd atom c_d[4]^2
variable  vv atom vx^2+vy^2+vz^2
compute   mean all reduce ave f_step v_dd v_vv vx vy vz
variable  path equal c_mean[1]/v_rin
variable  msd equal c_mean[2]/v_rin^2
variable  vvar equal c_mean[3]-c_mean[4]^2-c_mean[5]^2-c_mean[6]^2
compute   b all foam/bubble espring edurian rdot contacts
compute   edurian all reduce sum c_b[2]    # the energy that the thesis reports

thermo    ${report}
thermo_style custom step f_gas[1] f_gas[2] f_gas[3] f_gas[4] f_gas[5] pe v_path v_msd v_vvar c_edurian &
          f_step[2] f_step[5] cpu
thermo_modify norm no flush yes colname f_gas[1] tau colname f_gas[2] N colname f_gas[3] R colname f_gas[4] Rmax &
          colname f_gas[5] phi colname v_path path colname v_msd msd colname v_vvar vvar &
          colname c_edurian edurian colname f_step[2] h colname f_step[5] evals
"""
    return text


def _line() -> str:
    """A line of series.csv, on lines that LAMMPS joins."""
    rows, row = [], ""
    for value in COLUMNS.values():
        if len(row) + len(value) > 90:
            rows.append(row)
            row = ""
        row += f"{value},"
    rows.append(row.rstrip(","))
    return "&\n".join(rows)


def _flow(foam: Foam) -> str:
    unit = foam.sigma * foam.mean / foam.mu
    block = []
    for n, axis in enumerate("xyz"):
        for end, whole in ((foam.flow_lo[n], foam.flow_lo[n] <= 0), (foam.flow_hi[n], foam.flow_hi[n] >= 1)):
            across = n >= foam.dimension or whole
            block.append("INF" if across else f"$({axis}lo+l{axis}*{number(end)}:%.17g)")
    velocity = [value if n < foam.dimension else 0.0 for n, value in enumerate(foam.flow_velocity)]
    given = " ".join(map(number, velocity))
    return f"""
# a part of the box where the liquid flows; elsewhere bubbles go with those that they touch
# velocity: ({given}) of the input, in units of sigma * mean / mu = {number(unit)}
pair_style durian/foam ${{mu}} drag neighbor rin ${{mean}}
pair_coeff * * ${{sigma}}
region    flow block {' '.join(block)}
fix       flow all foam/flow region flow velocity {' '.join(number(v * unit) for v in velocity)} touch yes
"""


def _snapshots(gzip: bool) -> str:
    name, style = ("foam.lammpstrj.gz", "custom/gz") if gzip else ("foam.lammpstrj", "custom")
    return f"""
# snapshots: whenever one is written, LAMMPS asks for the time of the next
variable  shots equal f_gas[1]*v_frequency
variable  shot equal time+(floor(v_shots+1.0e-6)+1-v_shots)/v_frequency*v_rin^2/v_K
dump      foam all {style} 1 {name} &
          {DUMPED}
dump_modify foam every/time v_shot first ${{first}} append ${{append}} &
          {DUMP_FORMAT}
"""


DUMPED = ("id x y z ix iy iz radius vx vy vz f_step c_d[4] c_b[1] c_b[3] c_b[4]")
DUMP_FORMAT = ("sort id time yes format float %.9g colname f_step path colname c_d[4] distance &\n"
               "          colname c_b[1] energy colname c_b[3] rdot colname c_b[4] contacts")


def _tables(write: str, title: str, append: str, first: str) -> str:
    """How files begin: fix print writes a title before its first line, always; a dump may begin with the present."""
    return f"""variable  write string {write}
variable  title string "{title}"
variable  append string {append}
variable  first string {first}
"""


BY_TIME = """# Restart files by wall time: the next after as many steps as take ${save} seconds, by the steps so far.
# The largest time of all ranks counts, so that they agree.
variable  clock equal cpu
variable  clocks atom v_clock
compute   clock all reduce max v_clocks
variable  ahead equal ternary(10*c_clock<v_save,10*elapsed,elapsed*v_save/(c_clock+1.0e-9))
variable  next equal step+ternary(elapsed==0,100,ceil(v_ahead))
restart   v_next restart.*
"""
BY_STEPS = "restart   ${save} restart.*\n"


def _run(foam: Foam, gzip: bool, by_time: bool) -> str:
    return f"""# time series; lengths are in units of <R_in>
fix       series all print ${{every}} &
"{_line()}" &
          ${{write}} series.csv screen no title ${{title}}
{_snapshots(gzip) if foam.frequency > 0 else ""}
{BY_TIME if by_time else BY_STEPS}
# A file named stop ends the run, after a step that is a multiple of ${{every}}, so that it can be resumed
variable  stop equal is_file(stop)
fix       stop all halt ${{every}} v_stop > 0 error soft message no

run       1000000000
"""


def _end(foam: Foam) -> str:
    return f"""if "$(is_timeout()) == 1" then "write_restart restart.*" "print '--- stopped at step $(step)'" quit

# the last state, and its line in series.csv if it has none yet
if "$(step%v_every) == 0" then "jump SELF state"
print     &
"{_line()}" &
          append series.csv screen no
label     state
write_dump all custom last.lammpstrj &
          {DUMPED} &
          modify {DUMP_FORMAT}
print     "--- complete: step $(step), tau $(f_gas[1]:%.6g), $(f_gas[2]:%.0f) bubbles" file complete
"""


# ---- a run that goes on ---------------------------------------------------------------------------------------------

def sections(text: str, name: str) -> dict[str, str]:
    """Those of an in.foam, by their headings; the lines before the first are ''. Raises Unusable if one lacks."""
    pieces = re.split(r"^# -{4,} ([a-z ]+?) -*$\n?", text, flags=re.M)
    found = dict(zip(["", *pieces[1::2]], pieces[0::2]))
    missing = [section for section in SECTIONS if section not in found]
    if missing:
        raise Unusable(f"{name}: the heading '# ---- {missing[0]} ----' is not there, which resume needs to know "
                       "what comes instead of the start")
    return found


def going_on(text: str, name: str, restart: str, title: str | None, grid: str | None = None) -> str:
    """The text of in.resume: in.foam, but from a restart file.

    title: the last line of series.csv before the step of the restart file; None if that is of the relaxed foam, and
    tables are begun. grid: that of the ranks, if there are several.
    """
    found = sections(text, name)
    ranks = f"processors {grid}    # as before\n" if grid else ""
    found["start"] = "\n" + aligned(f"{ranks}read_restart {restart} noremap\n")
    if title is not None:
        found["tables"] = "\n# they go on; title is the last line of series.csv so far\n" \
                          + aligned(_tables("append", title, "yes", "no"))
    result = f"# Goes on from {restart}; all else is as in {name}. Written by lammps-foam resume.\n"
    for section in SECTIONS:
        if section != "relaxation":
            label = "restart" if section == "start" else section
            result += f"\n{heading(label)}\n{found[section].rstrip()}\n"
    return result
