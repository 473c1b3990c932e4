#!/usr/bin/env bash
# A Debian release's Mesa in a folder, with nothing to build with: llvmpipe, softpipe and zink by EGL, and OSMesa where
# the release has it. Finished programs (scripts/portable_folder.sh) are run in it. A folder that is whole is kept.
# Usage: scripts/mesa_root.sh SUITE DIR [--bind FOLDER PLACE]... [COMMAND...]
# SUITE is bookworm, trixie or sid. The command runs in DIR, where FOLDER is at PLACE. Needs root; the first time,
# debootstrap, two minutes and 1.5 GB.
set -euo pipefail
fail() { echo "mesa_root: $*" >&2; exit 2; }
[ $# -ge 2 ] || { sed -n 4p "$0" | cut -c3- >&2; exit 2; }
suite=$1 root=$2
shift 2
[ "$(id -u)" = 0 ] || fail "needs root, for debootstrap and chroot"

# Mounts go with the namespace they are in: nothing is left behind.
if [ "${LOCKSTEP_IN_NAMESPACE:-}" = yes ]; then
    unset LOCKSTEP_IN_NAMESPACE
    mount --rbind /dev "$root/dev"
    mount -t proc proc "$root/proc"
    while [ "${1:-}" = --bind ]; do
        mkdir -p "$root$3"
        mount --bind "$2" "$root$3"
        shift 3
    done
    exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"
fi
inside() { LOCKSTEP_IN_NAMESPACE=yes unshare --mount --propagation private "$0" "$suite" "$root" "$@"; }

make_root() {
    command -v debootstrap >/dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends debootstrap; } >/dev/null \
        || fail "debootstrap is missing and apt-get cannot install it"
    local mirror
    mirror=$(apt-get indextargets --format '$(REPO_URI) $(COMPONENT) $(LABEL)' 'Created-By: Packages' | awk '$2 == "main" && $3 == "Debian" { print $1; exit }')
    [ -n "$mirror" ] || fail "apt knows no Debian mirror here"
    rm -rf --one-file-system "$root"
    debootstrap --variant=minbase --include=ca-certificates "$suite" "$root" "$mirror" >"$root.log" 2>&1 \
        || { tail -n 5 "$root.log" >&2; fail "debootstrap cannot make a Debian $suite of $mirror"; }
    # How apt reaches the mirror from here: proxies, certificates, names.
    apt-config dump Acquire >"$root/etc/apt/apt.conf.d/99acquire"
    cp -r /etc/apt/auth.conf.d "$root/etc/apt/" 2>/dev/null || true
    cp /etc/resolv.conf /etc/hosts "$root/etc/"
    cp -r /usr/local/share/ca-certificates "$root/usr/local/share/" 2>/dev/null || true
    inside sh -c '
        export DEBIAN_FRONTEND=noninteractive
        update-ca-certificates && apt-get update -qq &&
        apt-get install -y -qq --no-install-recommends libegl1 libgl1-mesa-dri mesa-vulkan-drivers libvulkan1 libgl1 &&
        { ! apt-cache show libosmesa6 || apt-get install -y -qq --no-install-recommends libosmesa6; } &&
        apt-get clean' >>"$root.log" 2>&1 || { tail -n 5 "$root.log" >&2; fail "apt-get cannot install Mesa in $root; all of it: $root.log"; }
    touch "$root/made"
}

if [ ! -e "$root/made" ]; then # by one at a time
    mkdir -p "$(dirname "$root")"
    exec 9>"$root.lock"
    flock 9
    [ -e "$root/made" ] || make_root
    exec 9>&-
fi
[ $# = 0 ] || inside "$@"
