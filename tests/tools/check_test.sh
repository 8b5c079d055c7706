#!/usr/bin/env bash
# flyball check and flyball blocks.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

expect 0 check "$arc"
says out "arc_error_loop.toml: ok: 8 blocks, 2 states, 0 sample rates, 0 crossings"
is_empty err

sed -e 's/"Gain"/"Gian"/' -e 's/"Sum"/"Smu"/' "$arc" >"two errors.toml"
expect 3 check "$arc" "two errors.toml"
says out "arc_error_loop.toml: ok"
errors=$(grep -c '^two errors.toml:[0-9]*:[0-9]*: error: ' err)
says err "$errors errors"
((errors >= 2)) || fail "$last: $errors errors"

expect 5 check missing.toml "$arc"
says err "missing.toml: cannot be read"
says err "1 error"
says out "arc_error_loop.toml: ok"

cat >loop.toml <<'TOML'
flyball = 1
[blocks]
one = { type = "Constant" }
x = { type = "Sum" }
[diagram]
wires = ["one -> x.u1", "x -> x.u2"]
TOML
expect 0 check loop.toml
says err "loop.toml:4:1: note: algebraic loop, solved wherever it is evaluated: x.y -> x.u2 -> x.y"
says out "loop.toml: ok"
expect 0 check loop.toml --json
says out '"severity": "note"'
expect 4 run loop.toml
says err "loop.toml: error: algebraic loop at t = 0 s: no solution, x.y needs to differ from itself: x.y -> x.u2 -> x.y; an Integrator"

expect 0 check --json "$arc"
says out '"ok": true'
says out '"states": 2'

expect 0 check --units "$arc"
says out "signal  unit"
says out "H       m"
says out "K_gamma    1"
expect 0 check --units "$sources/models/benchmarks/robot.toml"
says out "robot.omega       rad/s"
expect 0 check --units --json "$arc"
says out '"name": "K_H",'
says out '"unit": "1/m"'
sed -e 's|unit = "1/m"|unit = "1/s"|' "$arc" >"wrong unit.toml"
expect 3 check "wrong unit.toml"
says err "error: K_H is in 1/s, but the diagram needs it in 1/m"
expect 3 run "wrong unit.toml"
says err "error: K_H is in 1/s, but the diagram needs it in 1/m"

expect 0 check --help
says out "Example:"

# A file with [study] is a study.
cat >study.toml <<TOML
flyball = 1
[study]
model = "arc.toml"
[sweep]
K_gamma = [0.5, 1.0, 2.0]
TOML
cp "$arc" arc.toml
expect 0 check study.toml arc.toml
says out "study.toml: ok: 1 model, 1 case, 1 scenario, 3 runs"
says out "arc.toml: ok: 8 blocks"
expect 0 check study.toml --json
says out '"runs": 3'
sed -i -e 's/K_gamma = /K_gama = /' study.toml
sed -i -e 's/"Sum"/"Smu"/' arc.toml
expect 3 check study.toml
says err "arc.toml:"
says err 'error: unknown block type "Smu"; did you mean "Sum"?'
says err 'study.toml:3:9: note: used here, as "arc"'
cp "$arc" arc.toml
expect 3 check study.toml --json
says err 'study.toml:5:1: error: there is no parameter "K_gama"; did you mean "K_gamma"?'
says out '"ok": false'
sed -i -e 's/K_gama = /K_gamma =    /' study.toml
expect 1 format --check study.toml
expect 0 format study.toml
expect 0 check study.toml

# Results are compared with their metadata.
expect 0 run "$arc" --quiet --output "a result.csv" --stop 1
expect 0 check "a result.csv" "$arc"
says out "a result.csv: ok: 1001 rows, 3 columns"
says out "arc_error_loop.toml: ok"
is_empty err
expect 0 check "a result.csv" --json
says out '"rows": 1001'
cp "a result.json" cut.json
head -n 11 "a result.csv" >cut.csv
expect 3 check cut.csv
says err "cut.csv: error: changed or truncated: expected the checksum fnv1a64:"
says err "cut.csv:12:1: error: the file ends after 10 of 1001 rows"
says err "2 errors"
is_empty out
expect 3 check cut.csv --json
says out '"ok": false'
says out '"line": 12'
sed -i 's/"finished"/"stopped"/' cut.json
expect 3 check cut.csv
says err "cut.json: error: changed or truncated: its text has the checksum fnv1a64:"
rm cut.json
expect 5 check cut.csv
says err "error: cut.json: cannot be read: No such file or directory"
expect 5 check missing.csv
says err "error: missing.csv: cannot be read: No such file or directory"

expect 0 blocks
says out "PID"
says out "control"
expect 0 blocks PID
says out "# PID"
says out '| `Kp` | any | 1 | any | proportional gain |'
says out '| `N` | rad/s | 100 | > 0 | pole of the derivative filter |'
says out '| `anti_windup` | `"none"` | none, clamping, back_calculation, tracking |'
says out '| rate of `integral` | `Ki`, `e` |'
expect 0 blocks PID --json
says out '"default": 100.0'
expect 0 blocks --help
says out "Example:"
expect 0 blocks --markdown "reference pages"
exists "reference pages/PID.md"
says "reference pages/index.md" "[PID](PID.md)"
"$flyball" blocks PID >out
cmp -s out "reference pages/PID.md" || fail "the written page is not the printed one"
finish
