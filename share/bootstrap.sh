#!/usr/bin/env bash
# Installs what grainbench is built with, from the packages of Debian 12. Does nothing, and needs no
# rights, where all of it is present.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libeigen3-dev libhwy-dev libtbb-dev                      # core
  libvtk9-dev libopenmpi-dev libhdf5-dev nlohmann-json3-dev libvalijson-dev  # io
  libosmesa6-dev libpng-dev                                # render
  libcli11-dev libspdlog-dev libfmt-dev                    # cli
  libgtest-dev libbenchmark-dev valgrind                   # tests
)

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "share/bootstrap.sh: no apt-get here; install the equivalents of: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "share/bootstrap.sh: neither root nor sudo; ask an administrator for: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "share/bootstrap.sh: installing ${missing[*]}" >&2
"${as_root[@]}" apt-get -qq -o Acquire::Retries=3 update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get -qq -y -o Acquire::Retries=3 install --no-install-recommends "${missing[@]}"
