#!/usr/bin/env bash
# flyball study: what it says and leaves, and its status.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

cat >lag.toml <<'TOML'
flyball = 1
[parameters]
T = { value = 0.5, unit = "s" }
[blocks]
x = { type = "Integrator", initial = 1.0 }
k = { type = "Gain", gain = "-1/T" }
[diagram]
wires = ["x -> k -> x"]
log = ["x"]
[simulation]
stop = "1 s"
TOML
cat >cases.toml <<'TOML'
flyball = 1
[study]
title = "Which lag?"
model = "lag.toml"
[cases]
fast = { T = "0.2 s" }
slow = { T = "0.8 s" }
[monte_carlo]
runs = 6
x.initial = { uniform = [0.9, 1.1] }
[metrics]
last = "final(x)"
[requirements]
decays = "final(x) < 1"
[[plot]]
title = "Lags"
signals = ["x"]
TOML

expect 0 study cases.toml
says out "Which lag? (cases.toml)"
says out "12 of 12 runs finished"
says out "95 % interval of the mean"
says out "Differences between runs of one sample"
for file in runs.csv summary.csv comparison.csv requirements.csv study.json study.sqlite plot-1.gp plot-1-fast.csv; do
  exists "cases-results/$file"
done
((($(wc -l <cases-results/runs.csv)) == 13)) || fail "$last: runs.csv has $(wc -l <cases-results/runs.csv) lines"
says cases-results/runs.csv "run,model,case,scenario,sample,seed,x.initial,status,last,passed decays,margin decays,end,reason"
nothing_half_written
expect 0 study cases.toml --status
says out "12 of 12 runs finished"
expect 0 study cases.toml --status --json --output nowhere
says out '"finished": 0'
is_missing nowhere

# Parts, merged, have the bytes of the whole.
for part in 1 2; do
  expect 0 study cases.toml --output "parts/part-$part" --shard "$part/2" --threads 1
  says out "part $part of 2"
  is_missing "parts/part-$part/runs.csv"
done
expect 0 study merge parts parts/part-1 parts/part-2
expect 0 study cases.toml --output parts --json
says out '"runs": 12'
for file in runs.csv summary.csv comparison.csv requirements.csv study.json plot-1-fast.csv plot-1.svg; do
  cmp -s "cases-results/$file" "parts/$file" || fail "$file differs"
done

# 1: a requirement does not hold
sed 's/final(x) < 1/final(x) < 0.1/' cases.toml >strict.toml
expect 1 study strict.toml --quiet
says err "requirement decays (final(x) < 0.1): broken in 6 of 12 runs, worst in case slow, sample "
is_empty out

# 2: usage
expect 2 study
says err "expected the name of a study file"
expect 2 study cases.toml --shard 3/2
says err 'expected a part such as 2/8, found "3/2"'
expect 2 study cases.toml --threads 0
expect 2 study merge parts

# 3: a study that is wrong
sed 's/final(x)"/finl(x)"/' cases.toml >broken.toml
expect 3 study broken.toml
says err "broken.toml:"
is_missing broken-results

# 4: all runs fail; each is a row
root_model | sed 's|sqrt(1 - u)|sqrt(1 - u/(1 s))|' >root.toml
printf 'flyball = 1\n[study]\nmodel = "root.toml"\n[metrics]\nlast = "final(x)"\n' >failing.toml
expect 4 study failing.toml --quiet
says err "warning: 1 of 1 run failed"
says failing-results/runs.csv "stopped,nan,"

# 5: input and output
expect 5 study missing.toml
expect 5 study cases.toml --output lag.toml
says err "lag.toml"
mkdir other
echo "no data base" >other/study.sqlite
expect 5 study cases.toml --output other
says err "the store of a study"

# The script of a cluster runs, in a shell that plays its part.
expect 0 study slurm cases.toml --output cluster --shards 3 --program "$flyball"
cp out job.sh
for part in 1 2 3; do SLURM_ARRAY_TASK_ID=$part SLURM_CPUS_PER_TASK=1 bash job.sh || fail "job $part"; done
bash job.sh join >out || fail "join"
cmp -s cases-results/runs.csv cluster/runs.csv || fail "the cluster's runs.csv differs"

# An interrupted study tells by the usual status, and goes on.
sed 's/runs = 6/runs = 40000/; /^\[\[plot\]\]/,$d' cases.toml >long.toml
env --default-signal=INT "$flyball" study long.toml >out 2>err &
pid=$!
sleep 0.3
kill -INT "$pid" 2>/dev/null
status=0
wait "$pid" || status=$?
last="flyball study, SIGINT"
((status == 130 || status == 0)) || fail "$last: status $status"
((status == 0)) || says out "the same command goes on from here"
expect 0 study long.toml --quiet
finish
