#!/usr/bin/env bash
# flyball run: what it prints, what it writes.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

expect 0 run "$arc"
says out "finished at t = 10 s"
says out "adams (named by the model), rtol 1e-08, atol 1e-10, steps of at most 0.2 s"
says out "gamma"
says out "Nothing was written; --output FILE.csv keeps the results."
is_empty err

expect 0 run "$arc" --output "result 1.csv" --set K_gamma=0.8 --set 'V=400 mm/s'
for ending in csv json gp svg png; do exists "result 1.$ending"; says out "result 1.$ending"; done
says "result 1.csv" "time,H,gamma"
says "result 1.json" '"V": "400 mm/s"'
says "result 1.json" '"status": "finished"'
nothing_half_written
rows=$(wc -l <"result 1.csv")
((rows == 1002)) || fail "1001 rows and a header expected, found $rows lines"

# The script draws the same figure again, by hand, in its folder.
rm "result 1.svg"
gnuplot "result 1.gp" 2>err || fail "gnuplot does not run the script"
exists "result 1.svg"

expect 0 run "$arc" --quiet --output quiet.csv
is_empty out
is_empty err

expect 0 run "$arc" --json --stop "2000 ms" --solver rk4 --step "1 ms" --log-interval "0.5 s"
says out '"rows": 5'
says out '"method": "rk4"'
says out '"steps": 2000'

expect 0 run "$arc" --solver dp5 --rtol 1e-5 --atol 1e-7 --max-step "50 ms"
says out "dp5 (asked for on the command line), rtol 1e-05, atol 1e-07, steps of at most 0.05 s"

expect 0 run "$arc" --profile
says out "Time in blocks: "
says out "state with the largest error"
expect 0 run "$arc" --profile --json --quiet
says out '"limiting"'
expect 0 run "$arc" --profile --json --output profiled.csv
says out '"until_instant"'
! grep -q until_instant profiled.json || fail "the sidecar depends on the machine"

# A jump at 1 s has two rows, one or none besides the asked times, which are 0 s and 3 s.
cat >jump.toml <<'TOML'
flyball = 1
[blocks]
step = { type = "Step", time = "1 s" }
x    = { type = "Integrator" }
[diagram]
wires = ["step -> x"]
log = ["step"]
[simulation]
stop = "3 s"
log_interval = "3 s"
TOML
for choice in both:5 after:4 none:3; do
  expect 0 run jump.toml --quiet --output jump.csv --event-rows "${choice%:*}"
  lines=$(wc -l <jump.csv)
  ((lines == ${choice#*:})) || fail "$last: $lines lines"
done

expect 0 run --help
says out "Example:"
says out "--event-rows"
expect 0 --version
says out "flyball "
finish
