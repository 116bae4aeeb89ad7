#!/usr/bin/env bash
# Runs the step of the container recipes (experiments/container/steps) in a bare root tree, as an image would: packages,
# build from source, judge, figure. Not part of tests/run, since it fetches a distribution and builds everything. Usage:
# bare_root.sh debian|ubuntu (as root). Exit status 77: skipped, with the reason.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
# shellcheck source=experiments/dependencies.sh
source "$root/experiments/dependencies.sh"
skip() { say "bare_root.sh: SKIPPED: $*"; exit 77; }
case "${1:-}" in
  debian) sources=("deb http://deb.debian.org/debian bookworm main") suite=bookworm ;;
  ubuntu)
    keys=/usr/share/keyrings/ubuntu-archive-keyring.gpg trust="[signed-by=$keys] "
    # Debian 12 has no package of Ubuntu's keys. The tree is thrown away, and nothing of it is kept.
    [ -f "$keys" ] || trust="[trusted=yes] "
    for part in noble noble-updates; do
      sources+=("deb ${trust}http://archive.ubuntu.com/ubuntu $part main universe")
    done
    suite=noble ;;
  *) say "Usage: bare_root.sh debian|ubuntu"; exit 2 ;;
esac
[ "$(id -u)" -eq 0 ] || skip "a root tree needs root: run it as root"
unshare -m true 2>/dev/null || skip "no namespace of mounts can be made here: run it where 'unshare -m' may"
install_packages mmdebstrap >&2 || skip "no mmdebstrap: install it"
git -C "$root" diff --quiet HEAD || say "bare_root.sh: the tree gets the last commit, not what changed since"

tree=$(mktemp -d)
trap 'rm -rf --one-file-system "$tree"' EXIT
mmdebstrap --quiet --variant=apt --skip=check/empty "$suite" "$tree" "${sources[@]}" ||
  skip "the packages of $1 can't be reached"
cp --remove-destination /etc/resolv.conf "$tree/etc/resolv.conf"
cp /etc/ssl/certs/ca-certificates.crt "$tree/certificates.crt"  # a proxy may have its own
git clone -q "$root" "$tree/ogc"

# Mounts end with the namespace.
unshare -m bash -s "$tree" <<'SH'
set -euo pipefail
mount -t proc proc "$1/proc"
mount --rbind /dev "$1/dev"
exec chroot "$1" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 PIP_CERT=/certificates.crt \
  bash -euo pipefail -c '
    /ogc/experiments/container/steps
    /ogc/build/default/ogc --version
    test -s /ogc/runs/fig18-smoke-cpu/fig18.png'
SH
echo "bare_root.sh: $1: built from source, judged and drawn"
