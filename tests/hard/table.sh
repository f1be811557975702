#!/usr/bin/env bash
# Prints the rows that the hard cases left in FILE ("HARD | case | quantity | threshold | seen") as one table.
set -euo pipefail
export LC_ALL=C.UTF-8
[ -s "${1:-}" ] || exit 0
{
  echo 'case | quantity | threshold | seen'
  sed 's/^HARD | //' "$1" | sort -u -V
} | sed 's/ | /\t/g' | column -t -s "$(printf '\t')" -o ' | ' | sed 's/ *$//'
