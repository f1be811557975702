#!/usr/bin/env bash
# check.sh PROGRAM SOURCE README: the example runs, links no graphics, and is what the README shows.
set -euo pipefail
program=$1 source=$2 readme=$3

answers=$("$program")
lines=$(wc -l <<<"$answers")
[ "$lines" -ge 5 ] || { echo "the example printed $lines lines:"; echo "$answers"; exit 1; }
grep -q '^N3' <<<"$answers" || { echo "Vienna is not in N3:"; echo "$answers"; exit 1; }
grep -q 'within 50 km$' <<<"$answers"

# What it links itself: OpenImageIO brings libraries of its own.
if readelf -d "$program" | grep -E 'NEEDED.*lib(epoxy|EGL|GL|OpenGL|glfw)'; then
  echo "the example links graphics"
  exit 1
fi

# The block of the README that begins as the source does.
shown=$(awk -v first="$(head -1 "$source")" '/^```/ { if (on) exit; fence = ($0 == "```cpp"); next }
  fence { on = ($0 == first); fence = 0 } on' "$readme")
diff <(cat "$source") <(echo "$shown") || { echo "README.md shows another example"; exit 1; }
