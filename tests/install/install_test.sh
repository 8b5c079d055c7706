#!/usr/bin/env bash
# install_test.sh BUILD COMPILER FLAGS: installs the build, and another project finds it, adds a block and runs it.
set -euo pipefail
build=$1
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d "${TMPDIR:-/tmp}/an installed flyball.XXXXXX")
trap 'rm -rf -- "$folder"' EXIT
cmake --install "$build" --prefix "$folder/prefix" >"$folder/log"
"$folder/prefix/bin/flyball" check "$folder"/prefix/share/flyball/models/classic/*.toml

cmake -S "$here/project" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" -DCMAKE_CXX_COMPILER="$2" \
  -DCMAKE_CXX_FLAGS="$3" >>"$folder/log"
cmake --build "$folder/build" >>"$folder/log" || { cat "$folder/log"; exit 1; }
"$folder/build/springs" run "$here/project/springs.toml" --quiet --output "$folder/springs.csv"
# The error of a run at rtol 1e-10 over one period.
tail -n 1 "$folder/springs.csv" |
  awk -F, '{ if ($2 < 1 - 1e-7 || $2 > 1 + 1e-7) { print "position " $2 " instead of 1"; exit 1 } }'
"$folder/build/springs" blocks StiffeningSpring >"$folder/page"
grep -q "how it grows" "$folder/page"
"$folder/build/springs" check "$here/project/springs.toml"
