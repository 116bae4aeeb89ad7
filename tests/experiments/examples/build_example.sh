#!/usr/bin/env bash
# Installs the library into a scratch folder and builds the example outside this tree, as a user of ogc::fast would.
# Usage: build_example.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" --component library > /dev/null
cp -r "$source/experiments/examples/contact_sets" "$scratch/example"
cmake -S "$scratch/example" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release \
  > "$scratch/log" || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/build" > "$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
"$scratch/build/contact_sets_example" | tee "$scratch/out"
grep -q 'contacts' "$scratch/out"
