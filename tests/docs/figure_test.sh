#!/usr/bin/env bash
# figure_test.sh FLYBALL SOURCES PAGE NAME: the figure docs/img/NAME.svg is the one that the model NAME.toml of the page
# gives.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
name=$4
kept=$2/docs/img/$name.svg
drawn=$folder/$name.svg
awk -v fence="\`\`\`toml file=$name.toml" '$0 == fence { inside = 1; next } /^```/ { inside = 0 } inside' "$2/$3" \
  >"$folder/$name.toml"
"$1" run "$folder/$name.toml" --quiet --output "$folder/$name.csv"

# Versions of gnuplot write the same curves in different words.
made_by() { grep -oE 'GNUPLOT [0-9.]+ patchlevel [0-9a-z]+' "$1" | head -n 1 || true; }
if [[ "$(made_by "$kept")" != "$(made_by "$drawn")" ]]; then
  echo "skipped: $kept was drawn by $(made_by "$kept"), here is $(made_by "$drawn")"
  exit 77
fi
cmp -- "$kept" "$drawn" || {
  echo "docs/img/$name.svg is stale: run $name.toml of $3 again and keep its $name.svg"
  exit 1
}
