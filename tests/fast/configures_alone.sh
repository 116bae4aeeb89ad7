#!/usr/bin/env bash
# ogc::fast alone configures with a compiler and oneTBB: every other package that the build asks for is hidden. The
# whole build must miss them, or they were not hidden. Usage: configures_alone.sh SOURCE_DIR
set -euo pipefail
source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
hidden=()
packages=$(grep -hoE 'find_package\(\w+' "$source/CMakeLists.txt" "$source/tests/CMakeLists.txt" | cut -d'(' -f2)
for package in $(sort -u <<< "$packages"); do
  [[ $package == TBB || $package == Threads ]] || hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
((${#hidden[@]} > 5)) || { echo "only ${#hidden[@]} packages found in CMakeLists.txt"; exit 1; }
configure() {
  cmake -S "$source" -B "$scratch/$1" -DOGC_CUDA=OFF "-DOGC_PROGRAM=$2" "${hidden[@]}" > "$scratch/log" 2>&1
}
configure alone OFF || { cat "$scratch/log"; exit 1; }
cmake --build "$scratch/alone" --target help > "$scratch/targets"
grep -q '\bogc_fast\b' "$scratch/targets" || { echo "there is no target ogc_fast"; exit 1; }
if configure whole ON; then
  echo "the whole build configures without its packages"
  exit 1
fi
grep -q 'CMAKE_DISABLE_FIND_PACKAGE_' "$scratch/log" || { cat "$scratch/log"; exit 1; }
