#!/usr/bin/env bash
# What accuracy costs: runs globe_round_trip_bench, writes its CSV, a table and a plot.
#     tests/bench/round_trip/round_trip.sh OUTPUT_FOLDER [NAME] [RUNS]
# Needs gnuplot. The real elevation is read from ../shared/data, and left out where it is missing.
set -euo pipefail
top=$(cd "$(dirname "$0")/../../.." && pwd)
out=${1:?give a folder for the results}
name=${2:-round-trip}
runs=${3:-3}
program=$top/build/release/tests/bench/round_trip/globe_round_trip_bench
[ -x "$program" ] || { echo "round_trip.sh: no $program: ./dev build first" >&2; exit 1; }
mkdir -p "$out"
csv=$out/$name.csv
"$program" "${GLOBE_DATA:-$top/../shared/data}" "$runs" >"$csv"

{
  echo "# Round trips: map, diamonds, map"
  echo
  echo "Written by \`tests/bench/round_trip/round_trip.sh\` on $(nproc) threads of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)."
  echo "The harmonics (all real ones of degree 1 to 64, 1000 m RMS, fixed seed) are a map of 1024 x 512 pixels, and"
  echo "what comes back is compared at 1536 x 768 other places, where they are known. Real maps are compared with"
  echo "their own pixels, which flatters nearest: its own samples come back. Back is linear in the trixel but where"
  echo "said (nearest: nearest). There and back are seconds of sampling, best of $runs; files and coarser levels"
  echo "not counted."
  echo
  echo "| map | filter | level | nodes | max, m | RMS, m | PSNR, dB | there, s | back, s |"
  echo "|---|---|--:|--:|--:|--:|--:|--:|--:|"
  tail -n +2 "$csv" | awk -F';' '{printf "| %s | %s | %s | %s | %.1f | %.2f | %.1f | %.3f | %.3f |\n", $1, $2, $3, $4, $6, $7, $8, $9, $10}'
} >"$out/$name.md"

plot=$(mktemp)
trap 'rm -f "$plot"' EXIT
cat >"$plot" <<PLOT
set terminal pngcairo size 1100,700 font "Sans,11"
set output "$out/$name.png"
set datafile separator ";"
set logscale xy
set autoscale xfix
set linetype 5 lc rgb "#cc3311"
set linetype 6 lc rgb "#555555"
set grid
set key outside right
set title "What accuracy costs: harmonics to degree 64 (1000 m RMS), 1024 x 512 pixels to diamonds and back"
set xlabel "time there and back, seconds (levels 6 to 10, from left)"
set ylabel "RMS error, metres"
row(f) = sprintf("< grep '^harmonics.*;%s;' %s", f, "$csv")
set style data linespoints
plot row("nearest") using (\$9+\$10):7 title "nearest" lw 2 pt 7, \
  row("bilinear") using (\$9+\$10):7 title "bilinear" lw 2 pt 7, \
  row("bicubic") using (\$9+\$10):7 title "bicubic" lw 2 pt 7, \
  row("area") using (\$9+\$10):7 title "area" lw 2 pt 7, \
  row("bicubic, back cubic") using (\$9+\$10):7 title "bicubic, back cubic" lw 2 pt 7, \
  row("--as-thesis, bilinear") using (\$9+\$10):7 title "the thesis' rows" lw 2 pt 5 dt 2
PLOT
gnuplot "$plot"
echo "$out/$name.csv, .md, .png" >&2
