#!/usr/bin/env bash
# The exit status of flyball, and what it says with each.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

# 2: usage
expect 2
says err "subcommand"
expect 2 run
expect 2 run "$arc" --unknown
expect 2 run "$arc" --set K_gamma
says err 'expected NAME=value, found "K_gamma"'
expect 2 run "$arc" --stop 0
says err "expected a value above 0 s, found 0"
expect 2 run "$arc" --stop "3 m"
expect 2 run "$arc" --rtol "1 s"
expect 2 run "$arc" --solver dp6
says err "dp5"
expect 2 run "$arc" --solver discrete
says err '--solver: the method "discrete" integrates nothing, but there are continuous states: H.x and 1 more'
expect 2 run "$arc" --event-rows some
expect 2 run "$arc" --output result.json
says err 'expected the name of a .csv file, found "result.json"'
expect 2 blocks PIDD
says err 'there is no block "PIDD"; did you mean "PID"?'

# 3: errors of the model, all of them, with their places
expect 3 run "$arc" --set K_gamma=9
says err "K_gamma"
expect 3 run "$arc" --set K_gama=1
says err "K_gamma"
expect 3 run "$arc" --set 'K_H=1 kg'
sed -e 's/"Gain"/"Gian"/' "$arc" >broken.toml
expect 3 run broken.toml --output broken.csv
says err "broken.toml:28:19: error: "
says err "Gain"
is_missing broken.csv
expect 3 run broken.toml --json
says out '"ok": false'
says out '"line": 28'

# 4: numerical failure; what was logged is written
root_model >root.toml
expect 4 run root.toml --output root.csv
says err "root.toml: error: "
says err "root.y"
says root.csv "0.875,"
says root.json '"status": "stopped"'
expect 0 check root.csv
nothing_half_written

# 5: input and output
expect 5 run missing.toml
says err "missing.toml: cannot be read: No such file or directory"
expect 5 run "$folder"
expect 5 run "$arc" --output missing/result.csv
says err "missing/result.csv: cannot be written: No such file or directory"
is_empty out
mkdir folder.csv
expect 5 run "$arc" --output folder.csv
says err "Is a directory"
expect 5 run "$arc" --output "broken.toml/result.csv"
says err "Not a directory"

status=0
"$flyball" run "$arc" >/dev/full 2>err || status=$?
last="flyball run >/dev/full"
((status == 5)) || fail "$last: status $status"
says err "standard output: cannot be written: No space left on device"

status=0
"$flyball" run "$arc" --output closed.csv >&- 2>err || status=$?
last="flyball run >&-"
((status == 5)) || fail "$last: status $status"
says err "standard output: cannot be written"
exists closed.csv
grep -q finished closed.csv && fail "the summary is in the results"

# A full disk: files may not grow beyond 8 kB, and no part of one is left.
status=0
last="flyball run on a full disk"
(trap '' XFSZ; ulimit -f 8; exec "$flyball" run "$arc" --output full.csv) >out 2>err || status=$?
((status == 5)) || fail "$last: status $status"
says err "full.csv: cannot be written: File too large"
is_missing full.csv
nothing_half_written
finish
