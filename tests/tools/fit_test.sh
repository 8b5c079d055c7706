#!/usr/bin/env bash
# flyball fit: what it prints, what it writes, what it refuses.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

cat >lag.toml <<'TOML'
flyball = 1
[model]
title = "A lag"
[parameters]
K = { value = "2 m" }
T = { value = "500 ms" }
h = { value = "1 s" }
[blocks]
u    = { type = "Constant", value = 1.0 }
goal = { type = "Gain", gain = "K" }
e    = { type = "Sum", signs = "+-" }
rate = { type = "Gain", gain = "1/T" }
y    = { type = "Integrator", initial = "0 m" }
hold = { type = "ZeroOrderHold", sample_time = "h" }
[diagram]
wires = ["u -> goal -> e.u1", "y -> e.u2, hold", "e -> rate -> y"]
log = ["y"]
[simulation]
stop = "2 s"
log_interval = "50 ms"
TOML
# What the model does with other values is what it is fitted to.
expect 0 run lag.toml --quiet --rtol 1e-12 --atol 1e-14 --set K=2.5 --set T=0.4 --output "the data.csv"

expect 0 fit lag.toml --data "the data.csv" --match y --parameters K,T
says out "A lag (lag.toml)"
says out "converged: "
says out "exact gradient"
says out "--set K=2.5 --set T=0.4"
is_empty err
set -- $(tail -1 out)
expect 0 "${@:2}" --quiet

expect 0 fit lag.toml --data "the data.csv" --match y=y --parameters K,T --bounds 'K=1 m:2400 mm' --start 'T=700 ms' \
  --output "the fit"
says out "- K is at its bound 2.4"
for ending in json toml csv gp svg png; do exists "the fit/fit.$ending"; says out "the fit/fit.$ending"; done
says "the fit/fit.csv" "time,y_data,y_before,y_after"
says "the fit/fit.toml" "fitted = { K = 2.4, T = 0."
says "the fit/fit.json" '"at_bound": true'
nothing_half_written

expect 0 fit lag.toml --data "the data.csv" --match y --parameters K,T --gradient numeric --json
says out '"gradient": "numeric"'
says out '"converged": true'
is_empty err
expect 0 fit lag.toml --data "the data.csv" --match y --parameters K --set T=0.4 --loss huber:0.1 --starts 3 --quiet
is_empty out

expect 4 fit lag.toml --data "the data.csv" --match y --parameters K,T --max-iterations 1
says err "lag.toml: error: no fit: stopped after 1 iterations, as max_iterations says"

# What cannot be meant.
expect 2 fit lag.toml --match y --parameters K
says err "--data is required"
expect 2 fit lag.toml --data "the data.csv" --match y --parameters K --bounds T=0:1
says err "error: --bounds: T is not one of --parameters"
expect 2 fit lag.toml --data "the data.csv" --match y --parameters K --bounds K=1
says err 'error: --bounds: K: expected LOWER:UPPER, such as 0:50, found "1"'
expect 2 fit lag.toml --data "the data.csv" --match y --parameters K --start 'K=2 kg'
says err 'error: --start: K: "2 kg": '
expect 2 fit lag.toml --data "the data.csv" --match y --parameters K --start K
says err '--start: expected NAME=value, found "K"'
expect 2 fit lag.toml --data "the data.csv" --match y --parameters K --loss square
says err 'expected one of squared, huber, soft_l1, cauchy, found "square"'
expect 3 fit lag.toml --data "the data.csv" --match y --parameters h,k
says err "error: h fixes the structure of a block: it takes a new plan"
says err 'error: there is no parameter "k"'
expect 3 fit lag.toml --data "the data.csv" --match y=Y --parameters K
says err 'the data.csv:1:1: error: there is no column "Y"'
expect 5 fit lag.toml --data nothing.csv --match y --parameters K
says err "nothing.csv"
expect 5 fit lag.toml --data "the data.csv" --match y --parameters K --output lag.toml/fit
says err "lag.toml/fit"
expect 0 fit --help
says out "Example:"
finish
