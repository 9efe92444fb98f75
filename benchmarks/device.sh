#!/usr/bin/env bash
# All figures of a GPU in one call of less than 8 minutes, on a machine with an NVIDIA GPU, Python
# 3, a C++ compiler, and best also with nvcc, compute-sanitizer and matplotlib.
#
#   device.sh LMP [OUT] [SECONDS]
#
# LMP      LAMMPS with the foam styles and KOKKOS with CUDA in one file ("./foam executable --device
#          cuda --arch ARCH FILE"), or such a file gzipped
# OUT      directory for the results (gpu-bench): bench.txt, bench.json, bench.png, sanitizer.txt
# SECONDS  all of it takes no longer than this (470)
#
# Measured are 10^4 to 10^7 bubbles in 2D and 3D, beside one core of the same machine up to 10^5,
# small packings first; what does not fit into the time is left out and named.

set -uo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
lmp=${1:?device.sh: needs a LAMMPS with CUDA and the foam styles}
out=${2:-gpu-bench}
end=$((SECONDS + ${3:-470}))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
PATH=$PATH:${CUDA_HOME:-/usr/local/cuda}/bin

if ! command -v nvidia-smi >/dev/null; then
  echo "device.sh: no nvidia-smi, so no NVIDIA GPU here" >&2
  exit 1
fi
case $lmp in
  *.gz) gunzip -c "$lmp" >"$work/lmp" ;;
  *) cp "$lmp" "$work/lmp" ;;
esac
chmod +x "$work/lmp"
lmp=$work/lmp

nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv,noheader
sanitize=70    # seconds kept for the checks at the end
python3 "$here/run.py" --lmp "$lmp" --lmp-cuda "$lmp" --backends base,cuda --full --host-max 1e5 \
  --what foam,hooke,history --repeat 2 --kernels --limit $((end - SECONDS - sanitize - 15)) \
  --out "$out" --cache "$work"
status=$?

# memory errors, races in shared memory, uninitialised reads: a small foam that coarsens so fast
# that bubbles vanish and lists are built within a few steps
check() {
  local tool=$1 left=$((end - SECONDS))
  echo "== compute-sanitizer --tool $tool"
  [ $left -ge 10 ] || { echo "no time left"; return; }
  timeout $((left < sanitize / 2 ? left : sanitize / 2)) \
    compute-sanitizer --tool "$tool" --print-limit 10 --error-exitcode 9 \
    "$lmp" -k on g 1 -sf kk -in "$here/in.speed" -log none -var file "$work/small.data" \
    -var what foam -var K 0.05 -var warm 5 -var steps 60 2>&1 |
    grep -E "^=========|^ERROR|^measured"
  status_of=${PIPESTATUS[0]}
  case $status_of in
    0) echo "passed" ;;
    124) echo "out of time" ;;
    *) echo "FAILED, status $status_of" ;;
  esac
}
if command -v compute-sanitizer >/dev/null; then
  "$lmp" -in "$here/in.packing" -log none -screen none -var N 500 -var file "$work/small.data"
  for tool in memcheck racecheck initcheck; do check $tool; done 2>&1 | tee "$out/sanitizer.txt"
else
  echo "no compute-sanitizer here" | tee "$out/sanitizer.txt"
fi
echo "device.sh: $SECONDS s"
exit $status
