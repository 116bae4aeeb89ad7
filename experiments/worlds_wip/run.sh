#!/bin/bash
# Runs worlds on one GPU: bits first, then times; at most 9 minutes. Output: $OUT/worlds.txt (default: beside this script).
here=$(cd "$(dirname "$0")" && pwd); out=${OUT:-$here}; end=$((SECONDS + 540))
export LD_LIBRARY_PATH=$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
b() { left=$((end - SECONDS)); [ $left -gt 5 ] || return; echo "\$ bench $*"; timeout $((left < ${T:-60} ? left : ${T:-60})) "$here/worlds_bench" "$@" 2>&1 || echo "status $?"; }
all() {
  nvidia-smi --query-gpu=name,driver_version,memory.used --format=csv,noheader
  if ! timeout 60 "$here/worlds_bench" smoke; then
    echo "smoke failed: $?"; echo "again with CUDA_MODULE_LOADING=EAGER"; export CUDA_MODULE_LOADING=EAGER
    timeout 60 "$here/worlds_bench" smoke || { echo "failed again: $?"; return; }
  fi
  T=90 b bits
  for threads in 64 128 256; do b cloth 1024 $threads 0; b cloth 1024 $threads 4; done
  b cloth 1 128 0; b cloth 128 256 0; b cloth 4096 64 4
  b cloth_one 1 128 0; b cloth_one 1024 128 0; b cloth_one 1024 128 4
  for threads in 128 256 512; do b sphere 256 $threads 0; done
  b sphere 1 512 0; b sphere_one 1 128 0
  echo "\$ tests"; timeout $((end - SECONDS > 5 ? end - SECONDS : 5)) "$here/tests_worlds" 2>&1 | tail -40
}
all > "$out/worlds.txt" 2>&1
cat "$out/worlds.txt"
