#!/usr/bin/env bash
# Installs the library into a scratch folder and builds each example outside this tree, as a user of ogc::fast would.
# Usage: build_example.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" --component library > /dev/null
# NAME PATTERN: builds and runs an example, whose output must match the pattern.
try() {
  cp -r "$source/experiments/examples/$1" "$scratch/$1"
  cmake -S "$scratch/$1" -B "$scratch/build_$1" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release \
    > "$scratch/log" || { cat "$scratch/log"; exit 1; }
  cmake --build "$scratch/build_$1" > "$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
  "$scratch/build_$1/$1_example" | tee "$scratch/out"
  grep -q "$2" "$scratch/out"
}
try contact_sets contacts
try cloth '^clean after 50 steps'
try guard '^detected, 3 vertices cut'
