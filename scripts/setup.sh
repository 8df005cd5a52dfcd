# Sourced by the other scripts: installs everything needed to build.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(
  g++ cmake ccache ninja-build pkg-config
  libcaf-dev libceres-dev libcli11-dev libeigen3-dev libfmt-dev libspdlog-dev nlohmann-json3-dev libopencv-dev
  libssl-dev libgraphviz-dev libpango1.0-dev librsvg2-dev libsqlite3-dev libstemmer-dev zlib1g-dev
  # Maps of robots.
  libmrpt-maps-dev libmrpt-slam-dev liboctomap-dev
  # Motions of arms; OMPL needs those of Boost without saying so. Descriptions of arms of others.
  libfcl-dev libompl-dev libboost-filesystem-dev libboost-serialization-dev libboost-system-dev libtinyxml2-dev
  # The font of timelines. Words that are spelt rightly.
  fonts-liberation2 wamerican-small
  # For the tests of what `castor new` makes.
  libgtest-dev
)
test_packages=(
  libgmock-dev librapidcheck-dev libbenchmark-dev clang-14 libclang-rt-14-dev openssl python3
  # Tools that open exported maps, and rawlogs.
  mrpt-apps mrpt-common octomap-tools
  # Simulators to compare the simulated robot, and the arm, with.
  libenki-dev libmujoco-dev libqhull-dev
  # Shells that complete castor's command lines, and the formatter of its manual pages.
  fish groff-base zsh
)

# Tools to build and check Debian packages.
package_packages=(debootstrap dpkg-dev fakeroot file lintian man-db)

# install_missing PACKAGE...
install_missing() {
  local missing=()
  local installed
  # dpkg-query fails if it does not know one of them, but still prints the others.
  installed=$({ dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' "$@" 2>/dev/null || true; } |
    sed -n 's/^ii *//p')
  local package
  for package in "$@"; do
    grep -qx -- "$package" <<<"$installed" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing: ${missing[*]}" >&2
      echo "Run this script as root, or install sudo." >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# Shows how far a build is and how long it has taken.
export NINJA_STATUS="[%f/%t, %es] "

# progress TEXT: shows the text as the last line of the terminal, if there is one; without TEXT,
# erases it.
progress() {
  [ -t 2 ] && [ "${TERM:-dumb}" != dumb ] || return 0
  printf '\r%.*s\e[K' "$((${COLUMNS:-80} - 1))" "${1:-}" >&2
}

# quietly COMMAND...: shows its output only if it fails.
quietly() {
  local output
  output=$("$@" 2>&1) || {
    echo "$output" >&2
    exit 1
  }
}

# configure PRESET CMAKE-OPTION...
configure() {
  quietly cmake --preset "$@"
}

# Builds the programs for users, in the same way as scripts/test, so that neither recompiles the
# other's files. Keeps the configuration of an existing build folder.
build_product() {
  install_missing "${packages[@]}"
  if [ ! -f build/release/build.ninja ]; then
    echo "Building; the first time takes some minutes."
    configure release -DCASTOR_TESTS=OFF -DCASTOR_BENCHMARKS=OFF -DCASTOR_UNITY=ON
  fi
  cmake --build --preset release --target castor_product
}
