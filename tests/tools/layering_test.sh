#!/usr/bin/env bash
# The layering check passes the sources and finds each kind of offence.
set -u
check=$(dirname -- "${BASH_SOURCE[0]}")/layering
"$check" "$1" || { echo "FAILED: the sources"; exit 1; }

root=$(mktemp -d)
trap 'rm -rf -- "$root"' EXIT
mkdir "$root/blocks" "$root/solvers" "$root/tools"
# offence FILE INCLUDE MESSAGE
offence() {
  echo "#include $2" >"$root/$1"
  found=$("$check" "$root") && { echo "FAILED: $2 in $1 passes"; exit 1; }
  [[ $found == "$1:1: error: $3" ]] || { echo "FAILED: $found"; exit 1; }
  rm "$root/$1"
}
offence blocks/a.h '"solvers/stepper.h"' "blocks/ includes from solvers/, which comes after it"
offence tools/a.h '<CLI/CLI.hpp>' "the heavy header CLI/CLI.hpp in a header"
offence solvers/a.h '<nlohmann/json.hpp>' "the heavy header nlohmann/json.hpp in a header"
offence blocks/a.h '"ceres/ceres.h"' "the heavy header ceres/ceres.h in a header"
offence tools/a.cpp '<cvodes/cvodes.h>' "SUNDIALS outside solvers/"

printf '#include "blocks/block.h"\n#include <CLI/CLI.hpp>\n#include <ceres/jet.h>\n' >"$root/tools/fine.cpp"
"$check" "$root" || { echo "FAILED: what is allowed does not pass"; exit 1; }
