#!/usr/bin/env bash
# semantics_test.sh SOURCES: each sentence S<n> of docs/semantics.md has a test of its number in tests/systems, and no
# test has a number without a sentence.
set -euo pipefail
cd -- "$1"

sentences=$(grep -oE '^- \*\*S[0-9]+\*\*' docs/semantics.md | grep -oE 'S[0-9]+' | sort -V)
tests=$(cat tests/systems/*.cpp | tr '\n' ' ' | grep -oE 'TEST_CASE\( *"S[0-9]+: ' | grep -oE 'S[0-9]+' | sort -Vu)
failed=0
complain() {
  if [[ -z $2 ]]; then return; fi
  printf '%s: %s\n' "$1" "$(xargs <<<"$2")"
  failed=1
}
[[ -n $sentences ]] || complain "docs/semantics.md" "no sentence"
complain "sentences that stand twice" "$(uniq -d <<<"$sentences")"
complain "sentences without a test in tests/systems" "$(comm -23 <(sort -u <<<"$sentences") <(sort -u <<<"$tests"))"
complain "tests in tests/systems without a sentence" "$(comm -13 <(sort -u <<<"$sentences") <(sort -u <<<"$tests"))"
exit "$failed"
