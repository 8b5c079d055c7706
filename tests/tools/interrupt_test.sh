#!/usr/bin/env bash
# A run that is interrupted writes what there is, and tells its caller by the usual status.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

# So many steps that no machine is done before the signal comes.
interrupted() {
  local signal=$1 wanted=$2 status=0
  last="flyball run, $signal"
  # A shell starts background jobs with SIGINT ignored; env gives it its default back.
  env --default-signal=INT "$flyball" run "$arc" --stop 1e9 --log-interval 1e6 --solver rk4 --step 1e-3 \
    --output "$signal.csv" >out 2>err &
  local pid=$!
  sleep 1
  kill "-$signal" "$pid"
  wait "$pid" || status=$?
  ((status == wanted)) || fail "$last: status $status instead of $wanted"
  says "$signal.json" '"status": "interrupted"'
  says "$signal.csv" "time,H,gamma"
  says out "interrupted at t = "
  expect 0 check "$signal.csv"
  nothing_half_written
}
interrupted INT 130
interrupted TERM 143
finish
