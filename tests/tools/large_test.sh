#!/usr/bin/env bash
# large_test.sh FLYBALL SOURCES BUILD_TYPE: diagrams of 100 000 blocks, of a million with FLYBALL_SOAK=1, with a stack of
# a megabyte.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"
blocks=100000
# A sanitizer takes several times the memory, time and stack.
if [[ $3 == Release ]]; then
  ulimit -s 1024
  [[ ${FLYBALL_SOAK:-} != 1 ]] || blocks=1000000
fi

"$sources/tools/generate_chain" $((blocks / 3 + 1)) chain.toml
expect 0 check chain.toml
says out "chain.toml: ok: $((3 * (blocks / 3 + 1) + 2)) blocks, $((blocks / 3 + 1)) states"

# Each block reads the one before it in the same instant: as deep as a diagram can be. Without `loop` a source begins.
row() {
  awk -v n="$1" -v loop="${2:-0}" 'BEGIN {
    print "flyball = 1\n[blocks]\nsource = { type = \"Constant\", value = 1.0 }\nsum = { type = \"Sum\" }"
    for (i = 1; i <= n; i++) printf "g%d = { type = \"Gain\", gain = 0.999 }\n", i
    print "[diagram]\nwires = [\n  \"source -> sum.u1\",\n  \"sum -> g1\","
    for (i = 2; i <= n; i++) printf "  \"g%d -> g%d\",\n", i - 1, i
    printf "  \"%s -> sum.u2\",\n]\nlog = [\"sum\"]\n", loop ? "g" n : "source"
    print "[simulation]\nstop = 1\nsolver = { method = \"euler\", step = 1 }\nlog_interval = 1"
  }'
}
row "$blocks" >row.toml
expect 0 check row.toml
says out "row.toml: ok: $((blocks + 2)) blocks"
row "$blocks" 1 >loop.toml
expect 0 check loop.toml
says err "algebraic loop, solved wherever it is evaluated: sum.y -> g1.u -> g1.y -> "

# Parameters that are computed from each other, the last one first.
awk -v n=$((blocks / 10)) 'BEGIN {
  print "flyball = 1\n[parameters]"
  for (i = 1; i < n; i++) printf "p%d = \"2 + p%d\"\n", i, i + 1
  printf "p%d = 1.0\n[blocks]\nc = { type = \"Constant\", value = \"p1\" }\n[diagram]\nlog = [\"c\"]\n[simulation]\nstop = 1\n", n
}' >parameters.toml
expect 0 check parameters.toml
expect 0 run parameters.toml
finish
