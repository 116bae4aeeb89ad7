# Functions for tests/run and experiments/reproduce that install missing packages and build. Debian 12 and Ubuntu 24.04
# have these names of packages (tests/experiments/container/bare_root.sh).

packages=(
  build-essential cmake ninja-build git ca-certificates
  python3 python3-dev python3-venv python3-yaml
  libcgal-dev libgmp-dev libmpfr-dev libboost-dev libtbb-dev libhdf5-dev zlib1g-dev
  libeigen3-dev libsuitesparse-dev libopenblas-dev
  nlohmann-json3-dev libcli11-dev libbenchmark-dev catch2
  libexpat1-dev libminizip-dev
  libegl1 libgl1 libgl1-mesa-dri libxrender1
)
# Used only if the Python package index can't be reached: curves are drawn with these packages, pictures of meshes are
# left out.
fallback_packages=(python3-matplotlib python3-numpy python3-h5py python3-jsonschema python3-jinja2 python3-markdown-it)

say() { printf '%s\n' "$*" >&2; }

missing_of() {
  local name
  for name in "$@"; do
    dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q '^install ok installed' || printf '%s\n' "$name"
  done
}

install_packages() {
  local missing as_root=()
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This system has no apt. Install the equivalents of: $*"
    return 1
  fi
  mapfile -t missing < <(missing_of "$@")
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "Not root and no sudo. Ask an administrator to run: apt-get install ${missing[*]}"
      return 1
    fi
    as_root=(sudo)
  fi
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq >&2 || say "apt-get update failed; trying with the lists at hand"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# Sets $python, and OGC_PYTHON for the build, to an interpreter with as many packages of the plots and of the Python
# package's build as possible.
prepare_python() {
  find_python "$1" || return 1
  export OGC_PYTHON=$python
}

find_python() {
  local root=$1 wanted stamp
  local lists=("$root/plots/requirements.txt" "$root/experiments/python/requirements.txt")
  wanted=$(cat "${lists[@]}" | cksum)
  stamp=$root/.venv/requirements.cksum
  if [ -x "$root/.venv/bin/python" ] && [ "$(cat "$stamp" 2>/dev/null)" = "$wanted" ]; then
    python=$root/.venv/bin/python
    return 0
  fi
  say "Preparing the Python environment in .venv"
  rm -rf "$root/.venv"
  if /usr/bin/env python3 -m venv "$root/.venv" && "$root/.venv/bin/python" -m pip install -q \
      --disable-pip-version-check "${lists[@]/#/--requirement=}" >&2; then
    printf '%s' "$wanted" > "$stamp"
    python=$root/.venv/bin/python
    return 0
  fi
  rm -rf "$root/.venv"
  say "The Python package index can't be reached: curves are drawn with the distribution's matplotlib; meshes are not" \
    "rendered, VTK checks are skipped, and the Python package is not built."
  install_packages "${fallback_packages[@]}" || return 1
  python=/usr/bin/python3
}

seconds_between_lines=30  # between lines of progress if standard error is no terminal

# Returns whether the build folder's setting of CUDA equals OGC_CUDA; true if OGC_CUDA is empty.
has_cuda_as_asked() {
  [ -z "${OGC_CUDA:-}" ] || grep -q "^OGC_CUDA:[A-Z]*=$OGC_CUDA\$" "$1/CMakeCache.txt"
}

# watch_build LOG: shows the progress of a build until the watcher is killed or its parent shell ends. A terminal gets
# one line that is redrawn, a file gets several lines.
watch_build() {
  local log=$1 begun=$SECONDS said=$SECONDS line count left
  while sleep 1 && kill -0 $$ 2>/dev/null; do
    count=$(tail -c 4000 "$log" 2>/dev/null | grep -oE '^\[[0-9]+/[0-9]+\]' | tail -n 1 | tr -d '[]' || true)
    [ -n "$count" ] || continue
    line="building ${count%/*} of ${count#*/}"
    # The first half minute is not extrapolated, because objects that were compiled before finish at once.
    if [ $((SECONDS - begun)) -ge "$seconds_between_lines" ] && [ "${count%/*}" -gt 0 ]; then
      left=$(((SECONDS - begun) * (${count#*/} - ${count%/*}) / ${count%/*}))
      if [ $left -lt 90 ]; then line+=", about $left s left"; else line+=", about $(((left + 30) / 60)) min left"; fi
    fi
    if [ -t 2 ]; then
      printf '\r%s\033[K' "$line" >&2
    elif [ $((SECONDS - said)) -ge "$seconds_between_lines" ]; then
      said=$SECONDS
      say "$line"
    fi
  done
}

# build ROOT PRESET [TARGETS…]: configures and builds; shows the progress, and the errors if it fails.
build() {
  local root=$1 preset=$2 log watcher status=0
  shift 2
  log=$root/build/$preset/log.txt
  mkdir -p "$root/build/$preset"
  if [ ! -f "$root/build/$preset/build.ninja" ] || ! has_cuda_as_asked "$root/build/$preset"; then
    say "Configuring build/$preset"
    (cd "$root" && cmake --preset "$preset" -G Ninja ${OGC_CUDA:+-DOGC_CUDA="$OGC_CUDA"}) > "$log" 2>&1 ||
      { cat "$log" >&2; return 1; }
  fi
  say "Building build/$preset (log: build/$preset/log.txt)"
  : > "$log"
  watch_build "$log" >/dev/null &
  watcher=$!
  ninja -C "$root/build/$preset" "$@" > "$log" 2>&1 || status=1
  kill $watcher 2>/dev/null
  wait $watcher 2>/dev/null || true
  [ ! -t 2 ] || printf '\r\033[K' >&2
  [ $status -eq 0 ] || grep -E -A20 'FAILED|error' "$log" | head -80 >&2
  return $status
}

