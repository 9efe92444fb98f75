#!/bin/sh
# Install/unInstall package files in LAMMPS
# mode = 0/1/2 for uninstall/install/update
#
# Puts the KOKKOS styles into the sources of LAMMPS (second argument: its src/ directory, default ..),
# beside the other KOKKOS styles. CMake picks up FILE_kokkos.cpp of each style FILE that is in src/, so
# the base styles come first:
#   sh src/FOAM/Install.sh 1 /path/to/lammps/src
#   sh src/KOKKOS_FOAM/Install.sh 1 /path/to/lammps/src

mode=${1:-1}
to=..
if [ "$2" ]; then
  to=$(cd "$2" && pwd) || exit 1    # before we leave the directory that it is relative to
fi
cd "$(dirname "$0")" || exit 1
if [ ! -e "$to/lammps.h" ]; then
  echo "Install.sh: $to is not the src/ directory of LAMMPS (no lammps.h in it)" >&2
  exit 1
fi
# make compiles the KOKKOS styles where "make yes-kokkos" has put them
if [ ! -e "$to/kokkos.h" ]; then
  to=$to/KOKKOS
fi
if [ ! -e "$to/kokkos.h" ]; then
  echo "Install.sh: this LAMMPS has no KOKKOS package (no $to/kokkos.h)" >&2
  exit 1
fi

for file in *.cpp *.h; do
  if [ "$mode" = 0 ]; then
    rm -f "$to/$file"
  elif ! cmp -s "$file" "$to/$file"; then
    cp "$file" "$to"
  fi
done
