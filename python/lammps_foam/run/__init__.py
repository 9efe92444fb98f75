"""lammps-foam run and lammps-foam resume: an input of the thesis' program, run by LAMMPS, and long runs that go on."""
