#!/usr/bin/env bash
# How soon after its start `globe view` shows its first picture: the built-in planet, an Earth made from the data where
# there are data, a scene with effects. Runs take turns; a median each with its 95 % interval, by order statistics.
#     tests/bench/first_picture.sh WORK_FOLDER [RUNS]
# Needs a display, or xvfb-run. A run before the first is left out: the driver keeps the programs that it compiled then.
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
work=${1:?give a folder for scratch and results}
runs=${2:-30}
globe=${GLOBE:-$top/build/release/app/globe}
heights=${GLOBE_DATA:-$top/../shared/data}/earth/earth_etopo20_f32.tif
mkdir -p "$work"
if [ -z "${DISPLAY:-}" ]; then
  command -v xvfb-run >/dev/null || { echo "first_picture.sh: no display: apt-get install xvfb xauth" >&2; exit 1; }
  exec xvfb-run -a -s '-screen 0 1400x900x24' "$0" "$@"
fi
shown=(procedural:7)
[ -f "$heights" ] && [ ! -d "$work/earth" ] && "$globe" convert "$heights" -o "$work/earth" --quiet
[ -d "$work/earth" ] && shown+=("$work/earth")
shown+=("$top/scenes/coast.toml")
csv=$work/first-picture.csv
echo "shown;run;seconds" >"$csv"
for ((run = 0; run <= runs; ++run)); do
  for planet in "${shown[@]}"; do
    seconds=$("$globe" view "$planet" --fresh --size 1280x720 --frames 1 --overlay off 2>/dev/null |
      sed -n 's/^first picture \([0-9.]*\) s$/\1/p')
    [ $run -gt 0 ] && echo "$(basename "$planet");$run;$seconds" >>"$csv"
  done
done
echo "| shown | runs | first picture, s (median, 95 %) |"
echo "|---|--:|--:|"
tail -n +2 "$csv" | sort -t';' -k1,1 -k3,3n | awk -F';' '
  function choose(n, k, c, i) { c = 1; for (i = 1; i <= k; ++i) c = c * (n - k + i) / i; return c }
  function row(n, k, outside, median) {
    n = count
    for (k = 0; outside + 2 * choose(n, k) / 2 ^ n <= 0.05 && k < n / 2; ++k) outside += 2 * choose(n, k) / 2 ^ n
    if (k < 1) k = 1
    median = n % 2 ? value[(n + 1) / 2] : (value[n / 2] + value[n / 2 + 1]) / 2
    printf "| %s | %d | %.2f (%.2f to %.2f) |\n", name, n, median, value[k], value[n + 1 - k]
  }
  $1 != name { if (count) row(); name = $1; count = 0 }
  { value[++count] = $3 }
  END { row() }'
