#!/usr/bin/env bash
# Standard streams that are closed, full, or whose reader went away: status 5, and a message where one can be read.
source "$(dirname -- "${BASH_SOURCE[0]}")/../tools/expect.sh"
sed 's/ = /=/' "$arc" >untidy.toml
expect 0 run "$arc" --quiet --output r.csv

cp "$arc" arc.toml  # a name without blanks: commands are cut into words
commands=("run arc.toml" "check arc.toml" "check r.csv" "graph arc.toml" "graph --order arc.toml"
  "format --check untidy.toml" "blocks" "blocks PID" "blocks --json" "blocks --schema" "--help" "--version"
  "diff arc.toml other.toml --json")
sed 's/"10 s"/"20 s"/' "$arc" >other.toml
for command in "${commands[@]}"; do
  # shellcheck disable=SC2086
  set -- $command
  status=0
  last="flyball $command >&-"
  "$flyball" "$@" >&- 2>err || status=$?
  ((status == 5)) || fail "$last: status $status"
  says err "error: standard output: cannot be written: Bad file descriptor"

  status=0
  last="flyball $command >/dev/full"
  "$flyball" "$@" >/dev/full 2>err || status=$?
  ((status == 5)) || fail "$last: status $status"
  says err "error: standard output: cannot be written: No space left on device"

  last="flyball $command | (nobody)"
  mkfifo pipe
  exec 3<>pipe 4>pipe 3>&-  # a writer is open, no reader is
  status=0
  "$flyball" "$@" >&4 2>err || status=$?
  exec 4>&-
  rm pipe
  ((status == 5)) || fail "$last: status $status"
  says err "error: standard output: cannot be written: Broken pipe"
done

# What was said to nobody leaves status and results as they are.
: >out
sed 's/"Gain"/"Gian"/' "$arc" >broken.toml
for closed in '2>&-' '2>/dev/full' '<&- 2>&-'; do
  status=0
  last="flyball check broken.toml $closed"
  eval "\"\$flyball\" check broken.toml $closed" || status=$?
  ((status == 3)) || fail "$last: status $status"
  status=0
  last="flyball run --quiet $closed"
  eval "\"\$flyball\" run \"\$arc\" --quiet --output closed.csv $closed" || status=$?
  ((status == 0)) || fail "$last: status $status"
  expect 0 check closed.csv
done
nothing_half_written
finish
