#!/usr/bin/env bash
# Builds the folder that `lobefit cost --isa --drivers DIR` compiles for Intel, Adreno and Mali GPUs with, where there are none:
#
#   crates/gpu/drivers/mesa.sh DIR
#
# Debian's Vulkan driver for Intel GPUs asks a kernel for a device; a shim preloaded into it answers (DIR/libintel_noop_drm_shim.so).
# Debian does not package the drivers for Adreno (freedreno) and Mali (panfrost), so these are built with their shims. All of it comes from the
# source of the Mesa that is installed, 770 objects: 6 minutes of processor time. Nothing outside of DIR is written but a temporary
# folder, which goes at the end; lists of source packages are made there from the apt sources that the machine has.
#
# Needs, on Debian:
#   apt-get install mesa-vulkan-drivers libvulkan1 dpkg-dev meson ninja-build python3-mako bison flex pkg-config gcc g++ \
#     libdrm-dev libelf-dev libexpat1-dev zlib1g-dev
set -euo pipefail
# Debian's Python first: it has the module that Debian's python3-mako is.
export PATH="/usr/bin:$PATH"

[ $# = 1 ] || { echo "usage: $0 DIR" >&2; exit 2; }
mkdir -p "$1"
out=$(cd "$1" && pwd)

for tool in apt-get dpkg-source meson ninja bison flex pkg-config gcc g++; do
  command -v "$tool" >/dev/null || { echo "$0: no $tool; the head of this script lists the packages" >&2; exit 2; }
done
version=$(dpkg-query --show --showformat '${source:Version}' mesa-vulkan-drivers) ||
  { echo "$0: install mesa-vulkan-drivers, whose source is built" >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/sources" "$work/lists/partial"

# The apt sources of this machine, for source packages.
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
  case "$file" in
    *.sources) sed 's/^Types:.*/Types: deb-src/' "$file" >"$work/sources/${file##*/}" ;;
    *.list) [ ! -f "$file" ] || sed -n 's/^deb[[:space:]]/deb-src /p' "$file" >"$work/sources/${file##*/}" ;;
  esac
done
apt() {
  apt-get -qq -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/sources" -o Dir::State::Lists="$work/lists" \
    -o APT::Sandbox::User=root "$@"
}

# Runs a step; what it prints is shown where it fails.
step() {
  echo "$1"
  shift
  "$@" >"$work/log" 2>&1 || { tail -n 40 "$work/log" >&2; exit 1; }
}

cd "$work"
step "lists of source packages" apt update
step "source of mesa $version" apt source "mesa=$version"
cd "$work"/mesa-*/
# No Vulkan driver for Intel: Debian's is there, and Mesa's tools for Intel have the shim alone.
step "configuration" meson setup "$work/build" --buildtype=release -Db_ndebug=true -Dvulkan-drivers=freedreno,panfrost \
  -Dgallium-drivers= -Dplatforms= -Dglx=disabled -Degl=disabled -Dgbm=disabled -Dopengl=false -Dgles1=disabled -Dgles2=disabled \
  -Dllvm=disabled -Dvalgrind=disabled -Dlibunwind=disabled -Dfreedreno-kgsl=false -Dtools=drm-shim,intel
libraries=(
  src/intel/tools/libintel_noop_drm_shim.so
  src/freedreno/vulkan/libvulkan_freedreno.so
  src/freedreno/drm-shim/libfreedreno_noop_drm_shim.so
  src/panfrost/vulkan/libvulkan_panfrost.so
  src/panfrost/drm-shim/libpanfrost_noop_drm_shim.so
)
step "drivers" ninja -C "$work/build" "${libraries[@]}"

for library in "${libraries[@]}"; do
  strip --strip-unneeded -o "$out/${library##*/}" "$work/build/$library"
done
for driver in freedreno panfrost; do
  printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "./libvulkan_%s.so", "api_version": "1.1.0"}}\n' "$driver" \
    >"$out/$driver.json"
done
echo "mesa $version: $out"
