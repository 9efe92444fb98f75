"""Analysis of foams: from what a run wrote to a table and a figure.

`read` reads tables and dumps, `figure` has the style of figures; each other module is a word of `lammps-foam`.
"""
