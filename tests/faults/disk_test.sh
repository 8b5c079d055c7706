#!/usr/bin/env bash
# A disk that is full, and one that is read-only. Mounting takes a name space of its own, which ends with the test.
if [[ ${FLYBALL_OWN_MOUNTS:-} != yes ]]; then
  if ! unshare --map-root-user --mount true 2>/dev/null; then
    echo "skipped: mounting is not allowed here"
    exit 77
  fi
  FLYBALL_OWN_MOUNTS=yes exec unshare --map-root-user --mount bash "$0" "$@"
fi
source "$(dirname -- "${BASH_SOURCE[0]}")/../tools/expect.sh"
mkdir disk reference
mount -t tmpfs -o size=2m tmpfs disk || exit 77

# 100 001 rows do not fit. The old files stay.
expect 0 run "$arc" --quiet --output disk/r.csv --log-interval 0.1
cp disk/r.csv disk/r.json .
expect 5 run "$arc" --quiet --output disk/r.csv --log-interval 1e-4
says err "error: disk/r.csv: cannot be written: No space left on device"
cmp -s r.csv disk/r.csv || fail "$last: the old file has changed"
expect 0 check disk/r.csv
nothing_half_written

# Less and less room: each file is whole, or is not there, and a missing one is an error.
expect 0 run "$arc" --quiet --output reference/r.csv
for room in 200 150 100 75 60 40 8 0; do
  rm -f disk/*
  head -c 3M /dev/zero >disk/filler 2>/dev/null
  truncate -s "-${room}K" disk/filler
  status=0
  last="flyball run with $room kB of room"
  "$flyball" run "$arc" --quiet --output disk/r.csv >out 2>err || status=$?
  count=0
  for ending in csv json gp svg png; do
    [[ -e disk/r.$ending ]] || continue
    count=$((count + 1))
    cmp -s "disk/r.$ending" "reference/r.$ending" || fail "$last: r.$ending is not whole"
  done
  if ((status == 0)); then
    ((count == 5)) || fail "$last: success with $count files"
  else
    ((status == 5)) || fail "$last: status $status"
    says err "error: disk/r."
    says err "cannot be written: "
  fi
  nothing_half_written
done
((status == 5)) || fail "the disk was not full"

# A study that finds the disk full says so; with room, it goes on to the same results.
cat >arc_study.toml <<TOML
flyball = 1
[study]
model = "arc.toml"
[sweep]
K_gamma = { from = 0.1, to = 4.0, points = 400 }
[metrics]
last = "final(H)"
TOML
cp "$arc" arc.toml
expect 0 study arc_study.toml --output reference/study --quiet
for room in 300 150 60 20 0; do
  rm -rf disk/*
  head -c 3M /dev/zero >disk/filler 2>/dev/null
  truncate -s "-${room}K" disk/filler
  expect 5 study arc_study.toml --output disk/study --quiet
  says err "No space left on device"
  rm disk/filler
  expect 0 study arc_study.toml --output disk/study --quiet
  for result in runs.csv summary.csv study.json; do
    cmp -s "disk/study/$result" "reference/study/$result" || fail "$last: $result differs"
  done
done

rm -rf disk/*
sed 's/ = /=/' "$arc" >disk/untidy.toml
cp disk/untidy.toml .
mount -o remount,ro disk || exit 77
expect 5 run "$arc" --output disk/r.csv
says err "error: disk/r.csv: cannot be written: Read-only file system"
is_empty out
expect 5 format disk/untidy.toml
says err "error: disk/untidy.toml: cannot be written: Read-only file system"
cmp -s untidy.toml disk/untidy.toml || fail "$last: the file has changed"
expect 5 graph "$arc" -o disk/g.svg
says err "Read-only file system"
expect 5 blocks --markdown disk/pages
says err "error: disk/pages: cannot be created: Read-only file system"
expect 0 format --check "$arc"
umount disk
finish
