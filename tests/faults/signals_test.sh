#!/usr/bin/env bash
# Ctrl-C and SIGTERM at any time, from the start of the program to the last file: the status tells of it, and the
# results are the old ones, or new ones that are whole.
source "$(dirname -- "${BASH_SOURCE[0]}")/../tools/expect.sh"

signalled() {
  local signal=$1 wanted=$2 delay=$3 status=0
  last="flyball run, $signal after $delay s"
  rm -f r.*
  cp old.csv r.csv
  # A shell starts background jobs with SIGINT ignored; env gives it its default back.
  env --default-signal=INT "$flyball" run "$arc" --output r.csv --log-interval 1e-3 >out 2>err &
  local pid=$!
  sleep "$delay"
  kill "-$signal" "$pid" 2>/dev/null
  wait "$pid" || status=$?
  # 0: it was done before.
  if ((status != 0 && status != wanted)); then fail "$last: status $status instead of $wanted"; fi
  if ! cmp -s old.csv r.csv; then expect 0 check r.csv; fi
  nothing_half_written
  ((status == wanted)) && caught=$((caught + 1))
}

echo old >old.csv
caught=0
for delay in 0.01 0.03 0.06 0.1 0.15 0.2 0.3 0.5; do
  signalled INT 130 "$delay"
  signalled TERM 143 "$delay"
done
((caught >= 2)) || fail "all runs were done before their signal"
finish
