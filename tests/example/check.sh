#!/usr/bin/env bash
# check.sh PROGRAM SOURCE README: the example runs, links no graphics, and is what the README shows.
set -euo pipefail
program=$1 source=$2 readme=$3

answers=$("$program")
lines=$(wc -l <<<"$answers")
[ "$lines" -ge 5 ] || { echo "the example printed $lines lines:"; echo "$answers"; exit 1; }
grep -q '^N31' <<<"$answers" || { echo "Vienna is not in N3:"; echo "$answers"; exit 1; }
grep -q 'within 50 km$' <<<"$answers"

if ldd "$program" | grep -E 'libepoxy|libEGL|libGL|libglfw'; then
  echo "the example links graphics"
  exit 1
fi

shown=$(sed -n '/^```cpp$/,/^```$/p' "$readme" | sed '1d;$d')
diff <(cat "$source") <(echo "$shown") || { echo "README.md shows another example"; exit 1; }
