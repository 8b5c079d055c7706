#!/usr/bin/env bash
# Fresh processes, several at a time and in other surroundings, write the same bytes.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

models="classic/bouncing_ball classic/recorded_command classic/robertson classic/sampled_dc_motor classic/two_rate_loop
  classic/diode_rectifier line_arc/arc_error_loop"
# The files of a run, without its drawings, in a folder of its own: the name of the CSV file is in the sidecar.
run() {
  mkdir -p "$2"
  (cd "$2" && "$flyball" run "$sources/models/$1.toml" --quiet --output r.csv && rm -f r.svg r.png) >out.$3 2>&1
}
k=0
for model in $models; do
  k=$((k + 1))
  run "$model" "$k/a" $k.a &
  LC_ALL=C TZ=Asia/Tokyo run "$model" "$k/b" $k.b &
  (export FLYBALL_TEST_PADDING="$(head -c 100000 /dev/zero | tr '\0' x)"; run "$model" "$k/c" $k.c) &
  (ulimit -s 1024; run "$model" "$k/d" $k.d) &
  wait
  for other in b c d; do
    for file in r.csv r.json r.gp; do
      cmp "$k/a/$file" "$k/$other/$file" || { cat out.$k.*; fail "$model: $file of process $other differs"; }
    done
  done
done
finish
