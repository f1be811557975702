#!/usr/bin/env bash
# Converts a map far larger than the memory allowed, and tells what bounds the speed.
#     tests/bench/scale/scale.sh WORK_FOLDER [WIDTHxHEIGHT] [MEMORY_MB] [LEVEL]
# 86400x43200 (15 arc seconds) takes 60 GB of disk at its own level (15), 20 GB at level 14.
set -euo pipefail
top=$(cd "$(dirname "$0")/../../.." && pwd)
work=${1:?give a folder for scratch and results}
size=${2:-86400x43200}
memory=${3:-1024}
level=${4:-14}
mkdir -p "$work"
map=$work/made-$size.tif
if [ ! -f "$map" ]; then
  echo "scale.sh: making $map row by row" >&2
  "$top/build/release/tests/bench/scale/globe_made_map" "${size%x*}" "${size#*x}" "$work/being-made.tif"
  mv "$work/being-made.tif" "$map"
fi
begin=$(date +%s.%N)
/usr/bin/time -o "$work/time" -f '%e;%U;%S;%M' "$top/build/globe" convert "$map" -o "$work/planet" --level "$level" \
  --memory "$memory" --overwrite --quiet --progress json 2> >(while read -r line; do echo "$(date +%s.%N) $line"; done >"$work/progress")
sleep 1
awk -F'[;]' -v size="$size" -v memory="$memory" -v level="$level" '{ split(size, s, "x")
  printf "%s to level %s: %.0f s (%.1f source Mpixel/s), %.0f s of processor, peak %.0f MB of %s allowed\n", size, level, $1, s[1] * s[2] / 1e6 / $1, $2 + $3, $4 / 1024, memory }' "$work/time"
du -sb "$work/planet" | awk '{ printf "planet: %.0f MB\n", $1 / 1e6 }'
# When each stage was last heard of.
awk -v begin="$begin" '{ match($0, /"stage": *"[^"]*"/); stage = substr($0, RSTART, RLENGTH); last[stage] = $1; if (!(stage in order)) { order[stage] = ++n; name[n] = stage } }
  END { before = begin; for (k = 1; k <= n; ++k) { printf "%s: %.0f s\n", name[k], last[name[k]] - before; before = last[name[k]] } }' "$work/progress"
