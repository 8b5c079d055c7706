#!/usr/bin/env bash
# links_test.sh SOURCES: what a Markdown page links to exists, headings included.
set -euo pipefail
cd -- "$1"
failed=0

# The anchors of a page, as Git hosts make them of headings.
anchors() {
  awk '/^```/ { code = !code } !code && /^#+ / { sub(/^#+ /, ""); print }' "$1" |
    tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

# Targets of [text](target) and ![text](target) outside of code.
targets() {
  awk '/^```/ { code = !code } !code' "$1" | sed 's/`[^`]*`//g' | grep -oE '\]\([^)]+\)' | sed 's/^](//; s/)$//' || true
}

complain() {
  echo "$1: no $2"
  failed=1
}

pages=0
while IFS= read -r -d '' page; do
  pages=$((pages + 1))
  while IFS= read -r target; do
    if [[ $target == http* || -z $target ]]; then continue; fi
    file=${target%%#*}
    file=${file:+$(dirname -- "$page")/$file}
    file=${file:-$page}
    if [[ ! -e $file ]]; then
      complain "$page" "$target"
    elif [[ $target == *'#'* ]] && ! grep -qxF -- "${target#*#}" < <(anchors "$file"); then
      complain "$page" "heading $target"
    fi
  done < <(targets "$page")
done < <(find . \( -name build -o -name out -o -name .git \) -prune -o -name '*.md' -print0)
((pages > 0)) || complain "$1" "Markdown pages"
exit "$failed"
