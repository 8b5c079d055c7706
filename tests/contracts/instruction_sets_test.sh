#!/usr/bin/env bash
# instruction_sets_test.sh LIBRARY...: of functions that several units define, the linker keeps any one. So what a unit
# with AVX2 instructions offers to it must carry the instruction set in its name, as the types of its lanes do: a
# standard function that was not inlined there would be taken by units that run on every machine.
set -euo pipefail
for library in "$@"; do
  units=$(ar t "$library" | grep -c '_avx2\.' || true)
  [[ $units -gt 0 ]] || { echo "$library has no unit for AVX2"; exit 1; }
  nm --print-file-name --extern-only --defined-only "$library" | awk '
    $2 ~ /^[TWi]$/ && /_avx2[.]/ && !/3IsaE1E/ { print "not marked as AVX2: " $0; ++errors }
    END { exit errors > 0 }'
done
