#!/usr/bin/env bash
# Makes the report's site and reads it in headless Chromium (browser.py): script errors, missing files, requests,
# contrast, the keyboard, a phone's width; keeps screenshots to look at. Installs Chromium where it is missing (its
# package alone is 77 MiB), and Playwright and axe-core in an environment of their own, build/browser (193 MiB), which
# is why this is not part of tests/run. Usage: browser.sh [FOLDER FOR SCREENSHOTS]
set -euo pipefail
case "${1:-}" in -h | --help) sed -n '2,/^set/s/^# \{0,1\}//p' "$0" | head -n -1; exit 0 ;; esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
here=$root/tests/paper_figures/workflow
# shellcheck source=experiments/dependencies.sh
source "$root/experiments/dependencies.sh"
install_packages "${packages[@]}" chromium
prepare_python "$root"
drivers=$root/build/browser list=$here/requirements-browser.txt
if ! cmp -s "$list" "$drivers/installed.txt"; then
  rm -rf "$drivers"
  /usr/bin/env python3 -m venv "$drivers"
  "$drivers/bin/python" -m pip install -q --disable-pip-version-check -r "$list"
  cp "$list" "$drivers/installed.txt"
fi
shots=$(realpath -m "${1:-$root/build/report_pictures}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
(cd "$root" && "$python" -m paper_figures.workflow.report --out "$scratch/site")
"$drivers/bin/python" "$here/browser.py" "$scratch/site" "$(command -v chromium)" "$shots"
say "Look at $shots"
