#!/usr/bin/env bash
# Installs the packages of Debian 12 or newer that a purpose needs. Does nothing where all are there. OSMesa left Debian
# after release 13; EGL gives the contexts there.
# Usage: scripts/install_packages.sh [--for demo|page|unit_tests|test|sanitize]      default: test, which is everything
#   demo        lockstep is built and run
#   page        scripts/build_report_page.sh
#   unit_tests  demo, and Catch2 for tests of your own
#   sanitize    demo and page, and what scripts/sanitize.sh and scripts/check_tidy.sh need
#   test        all but sanitize, and what lockstep's own tests, benchmarks and charts need
set -euo pipefail
fail() { echo "install_packages: $*" >&2; exit 2; }

demo=(
    g++ cmake ninja-build make                    # build; make is what cmake takes for a system of your own; g++ brings OpenMP
    libglm-dev libfmt-dev libcli11-dev            # vectors, text, command line
    nlohmann-json3-dev libpng-dev                 # scenes and reports, pictures
    zlib1g-dev                                    # the report page's data, traces
    libassimp-dev libmeshoptimizer-dev            # meshes: reading, decimation
    libhdf5-dev libaec-dev                        # traces: H5MD
    libdeflate-dev nettle-dev libxxhash-dev       # reading them fast, their seal
    libdtl-dev                                    # what a shader changes of the shipped one
    libedit-dev                                   # typed commands: editing, history, completion
    libseccomp-dev                                # the fence around the process that reads one
    libspirv-cross-c-shared-dev spirv-tools       # shaders in SPIR-V: what they declare, and their GLSL; whether they are right
    glslang-dev glslang-tools                     # shaders' own texts, compiled to SPIR-V in process; its CMake files name both
    libgl-dev libegl-dev                          # GL headers; the libraries are opened at run time
    libegl1 libgl1-mesa-dri                       # contexts without a GPU
)
# Where Node.js did not come from Debian, npm came with it.
page=()
command -v node >/dev/null || page+=(nodejs)
command -v npm >/dev/null || page+=(npm)
tests=(
    libgtest-dev doctest-dev                      # the other test frameworks there are headers for
    libnanoflann-dev                              # the oracle for neighbours
    libbenchmark-dev                              # benchmarks
    gnuplot-nox                                   # charts of lockstep study
    chromium                                      # the report page's tests
    dpkg-dev file                                 # Debian packages of lockstep
    python3-numpy python3-h5py                    # the example that writes a trace; states that the page saved become one
)

sanitize=(
    clang-19 libclang-rt-19-dev libomp-19-dev     # the compiler that has a fuzzer
    clang-tidy-19                                 # scripts/check_tidy.sh
    python3                                       # tests/matrix/run_matrix.py
)

purpose=${2-test}
if [ $# -gt 0 ] && [ "$1" != --for ]; then fail "'$1' is not an option; the only one is --for"; fi
if [ $# = 1 ] || [ $# -gt 2 ]; then fail "--for takes one of demo, page, unit_tests, test, sanitize"; fi
case $purpose in
demo) packages=("${demo[@]}") ;;
page) packages=("${page[@]}") ;;
unit_tests) packages=("${demo[@]}" catch2) ;;
sanitize) packages=("${demo[@]}" "${page[@]}" "${sanitize[@]}") ;;
test) packages=("${demo[@]}" catch2 "${page[@]}" "${tests[@]}") ;;
*) fail "--for: '$purpose' is not one of demo, page, unit_tests, test, sanitize" ;;
esac

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }
is_known() { apt-cache show "$1" >/dev/null 2>&1; }
no_osmesa() { echo "install_packages: this release has no libosmesa6; contexts come from EGL alone"; }

missing=()
for package in "${packages[@]}"; do is_installed "$package" || missing+=("$package"); done
if [ "$purpose" != page ] && ! is_installed libosmesa6; then
    if [ ${#missing[@]} = 0 ] && is_known libegl1 && ! is_known libosmesa6; then no_osmesa && exit 0; fi
    missing+=(libosmesa6)
fi
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "run as root, or install sudo; missing: ${missing[*]}"
    as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
if [[ " ${missing[*]} " == *" libosmesa6 "* ]] && ! is_known libosmesa6; then
    no_osmesa
    unset 'missing[-1]'
    [ ${#missing[@]} -gt 0 ] || exit 0
fi
echo "installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
