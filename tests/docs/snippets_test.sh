#!/usr/bin/env bash
# snippets_test.sh FLYBALL PAGE: follows a page of the documentation literally, from top to bottom, in an empty folder.
# What a fenced block does is in the words behind its fence:
#   toml file=NAME            is written to NAME
#   toml file=NAME from=OLD   is written to NAME as a copy of OLD in which lines of the same key are replaced
#   sh                        runs, with flyball on the PATH; exits with 0, or with N where it says status=N
#   text                      is all that the sh block before it prints; … stands for anything, alone for any lines
#   sh setup                  builds the project, which is done already
#   cpp                       is compiled by CMakeLists.txt of this folder
#   ebnf                      is grammar, for people
set -euo pipefail
export LC_ALL=C.UTF-8
bin=$(dirname -- "$(realpath -- "$1")")
page=$(realpath -- "$2")
work=$(mktemp -d "${TMPDIR:-/tmp}/a reader's folder.XXXXXX")
steps=$(mktemp -d)
trap 'rm -rf -- "$work" "$steps"' EXIT
cd -- "$work"
root=$(dirname -- "$page")
while [[ ! -e $root/CMakePresets.json ]]; do root=$(dirname -- "$root"); done

fail() {
  echo "$page:$line: $*"
  exit 1
}

# Prints a file as patterns of [[ … == … ]], a line each.
patterns() { sed 's/[][\\*?()|!@+]/\\&/g; s/…/*/g' -- "$1"; }

# Whether the lines of `got` from $2 on are those that the patterns of `want` from $1 on allow.
follows() {
  local w=$1 g=$2
  if ((w == ${#want[@]})); then return $((g < ${#got[@]})); fi
  if [[ ${want[w]} == '*' ]]; then
    for (( ; g <= ${#got[@]}; ++g)); do
      if follows $((w + 1)) "$g"; then return 0; fi
    done
    return 1
  fi
  # The right side is a pattern, so it stands without quotes.
  ((g < ${#got[@]})) && [[ ${got[g]} == ${want[w]} ]] && follows $((w + 1)) $((g + 1))
}

compare() {
  local want got
  mapfile -t want < <(patterns "$1")
  mapfile -t got <"$steps/printed"
  if follows 0 0; then return; fi
  diff -u --label "the page" --label "what is printed" -- "$1" "$steps/printed" || true
  fail "the command before prints something else"
}

# A copy of file $2 with each line of $1 in the place of the line with the same key.
with_lines_replaced() {
  awk 'function key(text) { sub(/ *=.*/, "", text); return text }
       NR == FNR { new[key($0)] = $0; next }
       key($0) in new { print new[key($0)]; done[key($0)] = 1; next }
       { print }
       END { for (k in new) if (!(k in done)) { print "no line to replace: " k >"/dev/stderr"; exit 1 } }' "$1" "$2"
}

write() {
  local name=${options#*file=} old
  [[ $options == file=* ]] || fail "a toml block needs file=NAME"
  name=${name%% *}
  mkdir -p -- "$(dirname -- "$name")"
  if [[ $options == *from=* ]]; then
    old=${options#*from=}
    with_lines_replaced "$body" "${old%% *}" >"$steps/copy" || fail "$old does not have these lines"
    cp -- "$steps/copy" "$name"
  else
    cp -- "$body" "$name"
  fi
}

run() {
  local wanted=0 status=0
  if [[ $options == status=* ]]; then wanted=${options#status=}; fi
  PATH="$bin:$PATH" bash -euo pipefail -- "$body" >"$steps/printed" 2>&1 </dev/null || status=$?
  if ((status != wanted)); then
    cat -- "$steps/printed"
    fail "status $status instead of $wanted"
  fi
}

# One file a block: its line in the page, the words behind the fence, the block.
awk -v folder="$steps" '
  inside && /^``` *$/ { inside = 0; close(file); next }
  inside { print >file; next }
  /^```/ { inside = 1; file = sprintf("%s/block-%03d", folder, ++n); print NR "\n" substr($0, 4) >file }' "$page"

# Pages on shipped models are read in the folder of the project.
if [[ $page == */docs/robots/* ]]; then ln -s -- "$root/models" "$root/studies" .; fi
before=none
for step in "$steps"/block-*; do
  { read -r line; read -r language options || true; } <"$step"
  body=$steps/body
  tail -n +3 -- "$step" >"$body"
  case "$language $options" in
    "toml "*) write ;;
    "sh setup" | "ebnf ") ;;
    "sh "*) run ;;
    "text ") [[ $before == sh ]] && compare "$body" || fail "no command prints this" ;;
    "cpp "*) [[ $page == */first-block.md ]] || fail "blocks are compiled from first-block.md only" ;;
    *) fail "blocks of this kind are not checked: \"$language $options\"" ;;
  esac
  before=$language
done
[[ $before != none ]] || { line=1; fail "no snippets"; }
