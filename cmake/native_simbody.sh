#!/usr/bin/env bash
# Builds Debian's own Simbody source package without its assertions (NDEBUG) and for x86-64-v3 into the
# user's cache, once, and prints the folder it lies in. Nothing on the system is changed: apt works in
# folders of its own here, and checks the source's signature as it does for any package.
set -euo pipefail

flags='-O3 -DNDEBUG -march=x86-64-v3'

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }
fail() { printf 'native_simbody: %s\n' "$*" >&2; exit 2; }

version=$(dpkg-query -W -f='${source:Version}' libsimbody-dev 2>/dev/null) ||
  fail "the package libsimbody-dev is not installed, so its version is not known. Try: ./bootstrap packages"
compiler=$(c++ -dumpfullversion)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/ballbot
prefix=$cache/simbody-$version-gcc-$compiler-x86-64-v3
if [ -f "$prefix/built" ] && [ "$(cat "$prefix/built")" = "$flags" ]; then
  printf '%s\n' "$prefix"
  exit 0
fi

mkdir -p "$cache"
work=$(mktemp -d "$cache/building-XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# The same mirrors and releases as the binary packages come from, asked for their sources.
mkdir -p "$work"/lists/partial "$work"/archives/partial
apt-get indextargets --format 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $(REPO_URI) $(RELEASE) $(COMPONENT)' \
  'Origin: Debian' 'Identifier: Packages' >"$work/sources.list"
[ -s "$work/sources.list" ] || fail "apt knows no Debian repository. Try: apt-get update"
apt=(apt-get -q -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=/dev/null
     -o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work" -o "APT::Sandbox::User=$(id -un)")
say "Fetching the source of Simbody $version"
(cd "$work" && "${apt[@]}" update && "${apt[@]}" source --only-source "simbody=$version") >"$work/log" 2>&1 || {
  cat "$work/log" >&2
  fail "the source package simbody $version could not be fetched; the lines above say why"
}
source=$(find "$work" -mindepth 1 -maxdepth 1 -type d -name 'simbody-*')

say "Building Simbody $version with $flags (once; some minutes)"
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache)
# The build type None leaves all flags to us, as Debian's packaging does; its warnings are not ours to mend.
cmake -S "$source" -B "$work/build" -G Ninja -Wno-dev "${launcher[@]}" \
  -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$flags -w" -DCMAKE_C_FLAGS="$flags -w" \
  -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_RPATH='$ORIGIN' \
  -DSIMBODY_VISUALIZER_INSTALL_DIR="$prefix/libexec" -DBUILD_EXAMPLES=OFF -DBUILD_TESTING=OFF -DBUILD_VISUALIZER=OFF \
  -DINSTALL_DOCS=OFF >"$work/log" 2>&1 || {
  cat "$work/log" >&2
  fail "Simbody's build could not be configured; the lines above say why"
}
cmake --build "$work/build" >&2
DESTDIR=$work/stage cmake --install "$work/build" >"$work/log"
staged=$work/stage$prefix
cp "$source/debian/copyright" "$staged/copyright"
printf '%s\n' "$flags" >"$staged/built"
rm -rf "$prefix"
mv "$staged" "$prefix"
printf '%s\n' "$prefix"
