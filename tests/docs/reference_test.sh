#!/usr/bin/env bash
# reference_test.sh FLYBALL SOURCES: the pages of docs/reference are those that the catalogue gives.
set -euo pipefail
fresh=$(mktemp -d)
trap 'rm -rf -- "$fresh"' EXIT
"$1" blocks --markdown "$fresh" >/dev/null
diff -ru -- "$2/docs/reference" "$fresh" || {
  echo "docs/reference is stale. Make it anew, in the folder of the sources:"
  echo "  rm -r docs/reference && build/release/flyball blocks --markdown docs/reference"
  exit 1
}
