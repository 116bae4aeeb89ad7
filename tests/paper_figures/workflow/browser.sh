#!/usr/bin/env bash
# Opens the report in headless Chromium: every picture is shown, nothing is asked of the network; takes a screenshot to
# look at. Installs Chromium where it is missing (its package alone is 77 MiB), which is why this is not part of
# tests/run. Usage: browser.sh [SCREENSHOT.png]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
# shellcheck source=experiments/dependencies.sh
source "$root/experiments/dependencies.sh"
install_packages "${packages[@]}" chromium
prepare_python "$root"
mkdir -p "$root/build"
picture=${1:-$root/build/report.png}
"$python" "$root/tests/paper_figures/workflow/report.py" "$root" --browser "$(command -v chromium)" "$picture"
say "Look at $picture"
