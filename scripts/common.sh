# SPDX-License-Identifier: LGPL-2.1-or-later
# What run_shear and run_tests have in common: install what is missing on
# Debian, configure, build. Read by them, not run.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)

fail()
{
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# install_missing PACKAGE...: a second run finds nothing missing and costs
# nothing.
install_missing()
{
  command -v dpkg-query > /dev/null 2>&1 ||
    fail "this is not Debian, so nothing can be installed by itself. Install" \
         "deal.II 9.4 or newer (with MPI and Trilinos), CMake, a C++17" \
         "compiler, GSL, Catch2 2.x and gnuplot, then see 'Build by hand' in" \
         "README.md."

  missing=
  for package in "$@"; do
    case $(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null) in
      installed) ;;
      *) missing="$missing $package" ;;
    esac
  done
  [ -n "$missing" ] || return 0

  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo > /dev/null 2>&1 ||
      fail "these Debian packages are missing, and there is no sudo to" \
           "install them:$missing"
    as_root=sudo
  fi
  echo "Installing:$missing"
  # shellcheck disable=SC2086 # a list of words
  { $as_root apt-get update &&
    $as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install --yes --no-install-recommends $missing; } ||
    fail "apt-get could not install:$missing. Is this machine on the network," \
         "and is it Debian 12?"
}

# build FOLDER TYPE [CMAKE OPTIONS]
build()
{
  folder=$1
  type=$2
  shift 2
  # A heavy file takes 1.5 GB to compile.
  jobs=$(nproc)
  memory=$(awk '/MemAvailable/ { print int($2 / 1.5e6) }' /proc/meminfo)
  [ "$jobs" -le "$memory" ] || jobs=$memory
  [ "$jobs" -ge 1 ] || jobs=1
  cmake -S "$top" -B "$folder" -DCMAKE_BUILD_TYPE="$type" "$@" > "$folder.log" 2>&1 ||
    { cat "$folder.log" >&2; fail "CMake failed, see above"; }
  # Warnings (a slow BLAS) must be seen.
  sed -n '/CMake Warning/,/^$/p' "$folder.log"
  rm -f "$folder.log"
  cmake --build "$folder" --parallel "$jobs" ||
    fail "the build failed, see above"
}

packages="cmake make g++ libdeal.ii-dev libgsl-dev libopenblas0-serial gnuplot-nox"
