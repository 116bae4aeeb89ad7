#!/usr/bin/env bash
# Installs the library into a scratch folder, builds the example plug-ins and both files of
# experiments/plugins/README.md outside this tree, as a new user would, and checks their verdicts. Usage:
# build_plugins.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$(cd "$1" && pwd) source=$(cd "$2" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" --component library > /dev/null
cd "$scratch"
cp "$source"/experiments/plugins/examples/*.cpp .
# The page's code blocks that are marked as mine.cpp: the first is wrong, the second is right.
awk '/^<!-- mine.cpp -->/ { n++; wanted = 1 }
     /^```$/ { writing = 0 }
     writing { print > ("page" n ".cpp") }
     /^```cpp$/ && wanted { writing = 1; wanted = 0 }' \
  "$source/experiments/plugins/README.md"

# verdict NAME STAGE EXIT_STATUS TEXT: builds the plug-in without warnings, judges it, and checks that the exit status
# is EXIT_STATUS and the output contains TEXT.
verdict() {
  g++ -O2 -Wall -Wextra -Werror -shared -fPIC -I "$scratch/prefix/include/ogc" "$1.cpp" -o "$1.so"
  local status=0
  "$build/ogc" compare "$2" --plugin "./$1.so" --cases 20000 > "$1.out" 2>&1 || status=$?
  if [ "$status" -ne "$3" ] || ! grep -q "$4" "$1.out"; then
    echo "$1: exit status $status instead of $3, or '$4' is missing:"
    cat "$1.out"
    exit 1
  fi
}

verdict activation activation 0 'activation: passed'
verdict tetrahedron tetrahedron 0 'tetrahedron: passed'
verdict barrier barrier 0 'barrier: passed'
verdict ccd ccd 0 'ccd: passed'
verdict volume_force volume_force 0 'volume_force: passed'
verdict truncate truncate 1 'the stored position is .* from the previous one, bound'
verdict page1 truncate 1 'your answer equals `rounded_to_nearest`'
verdict page2 truncate 0 'truncate: passed'
for file in "$source"/experiments/plugins/examples/*; do
  [ "$(wc -l < "$file")" -lt 80 ] || { echo "$file: not under 80 lines"; exit 1; }
done
