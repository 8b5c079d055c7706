#!/usr/bin/env bash
# flyball format and flyball diff.
source "$(dirname -- "${BASH_SOURCE[0]}")/expect.sh"

sed '/^#/!{s/ = /=/; s/^[a-z]/  &/}' "$arc" >untidy.toml
expect 1 format --check untidy.toml
says out "untidy.toml: would be formatted"
expect 0 format untidy.toml
says out "untidy.toml: formatted"
cmp -s untidy.toml "$arc" || fail "$last: not the layout of the shipped model"
expect 0 format --check --json untidy.toml
says out '"changed": false'
printf 'a = [1,\n' >broken.toml
expect 3 format broken.toml
says err "broken.toml:"
[[ $(cat broken.toml) == 'a = [1,' ]] || fail "$last: the broken file was changed"
expect 5 format missing.toml
nothing_half_written
expect 0 format --help
says out "Example:"

# Layout, comments, order, units and the names of ports that need none are no difference.
{
  sed -e '/^\[parameters\]/,/^$/d' -e 's/"gamma -> K1 -> E.u1"/"K1.y -> E.u1", "gamma -> K1"/' -e 's/^#.*//' "$arc"
  sed -n -e 's/"500 mm\/s"/"0.5 m\/s"/' -e '/^\[parameters\]/,/^$/p' "$arc"
} >moved.toml
expect 0 diff "$arc" moved.toml
is_empty out

sed -e 's/^K_H .*/K_H = { value = 3.0, unit = "1\/m", doc = "gain of the distance error" }/' -e 's/^sine .*/sine = { type = "Abs" }/' \
  -e '/^wires/a "H -> scope",' -e '/^\[blocks\]/a scope = { type = "Gain" }' -e 's/"10 s"/"20 s"/' "$arc" >other.toml
expect 1 diff "$arc" other.toml
is_empty err
says out '  ~ K_H.value: 2.0 -> 3.0'
says out '  ~ sine.type: "TrigonometricFunction" -> "Abs"'
says out '  + scope = { type = "Gain" }'
says out '  + H.y -> scope.u'
says out '  ~ stop: "10 s" -> "20 s"'
[[ $(grep -c '^  ' out) -eq 6 ]] || fail "$last: $(grep -c '^  ' out) differences instead of 6"
expect 1 diff "$arc" other.toml --json
says out '"kind": "added"'
echo 'flyball = 1' >empty.toml
expect 3 diff "$arc" empty.toml
says err "empty.toml:"
expect 5 diff "$arc" missing.toml
expect 2 diff "$arc"
expect 0 diff --help
says out "Example:"
finish
