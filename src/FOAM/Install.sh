#!/bin/sh
# Install/unInstall package files in LAMMPS
# mode = 0/1/2 for uninstall/install/update
#
# Puts the styles into the sources of LAMMPS (second argument: its src/ directory, default ..), where
# both of its build systems, CMake and make, pick up every .cpp file and its style macros.
#   sh src/FOAM/Install.sh 1 /path/to/lammps/src

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

for file in *.cpp *.h; do
  case $file in foamplugin.cpp) continue ;; esac    # registers styles of the plugin only
  if [ "$mode" = 0 ]; then
    rm -f "$to/$file"
  elif ! cmp -s "$file" "$to/$file"; then
    cp "$file" "$to"
  fi
done
