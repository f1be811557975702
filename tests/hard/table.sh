#!/usr/bin/env bash
# Prints the rows that the hard cases left in FILE ("HARD | case | quantity | threshold | seen") as one table.
set -euo pipefail
[ -s "${1:-}" ] || exit 0
{
  echo 'case | quantity | threshold | seen'
  sed 's/^HARD | //' "$1" | sort -u -V
} | column -t -s '|' -o '|'
