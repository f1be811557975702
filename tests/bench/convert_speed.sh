#!/usr/bin/env bash
# globe convert beside gdalwarp doing comparable work: the same source, every filter both have, all cores, the same
# compression and tile size; runs take turns. Prints a table (Markdown) and writes every run to a CSV.
#     tests/bench/convert_speed.sh WORK_FOLDER [RUNS]
# Bilinear writes the finest level that the source fills (its default), average the one below, so that pixels are
# averaged. gdalwarp reprojects to the cylindrical equal-area projection, a global raster as fine along the equator as
# that level (4n x 2n pixels, float32 for heights), without overviews. globe samples at half as many places, and writes
# all coarser levels too, and the layers made of heights (relief, range, mean).
# Two more rows of gdalwarp stand beside it, since it alone does less: it puts a pixel up to 0.125 pixels off (-et), where
# globe is exact, and makes no coarser levels. "exact": gdalwarp -et 0. "overviews": gdaladdo -r average after it, packed
# alike, down to 64 pixels; one such pyramid, where globe makes two of heights.
# Needs gdal-bin and GNU time. SYNTHETIC=WxH sets the size of the large made-up source (0x0: none).
set -euo pipefail
top=$(cd "$(dirname "$0")/../.." && pwd)
work=${1:?give a folder for scratch and results}
runs=${2:-7}
globe=${GLOBE:-$top/build/release/app/globe}
data=${GLOBE_DATA:-$top/../shared/data}
synthetic=${SYNTHETIC:-21600x10800}
mkdir -p "$work"
csv=$work/convert-speed.csv
for program in gdalwarp gdaladdo gdal_translate gdalinfo; do
  command -v $program >/dev/null || { echo "convert_speed.sh: no $program: apt-get install gdal-bin" >&2; exit 1; }
done
[ -x /usr/bin/time ] || { echo "convert_speed.sh: no GNU time: apt-get install time" >&2; exit 1; }
echo "source;filter;program;run;seconds;user_s;peak_kb;bytes" >"$csv"

measure() {  # source filter program run output command...
  local label="$1;$2;$3;$4" output=$5
  shift 5
  rm -rf "$output" "$output.partial"
  sync
  /usr/bin/time -o "$work/time" -f '%e;%U;%M' "$@" >/dev/null 2>"$work/errors" ||
    { cat "$work/errors" >&2; echo "convert_speed.sh: failed: $*" >&2; exit 1; }
  echo "$label;$(tail -1 "$work/time");$(du -sb "$output" | cut -f1)" >>"$csv"
}

compare() {  # name source width projection gdal_options globe_options...
  local name=$1 source=$2 width=$3 projection=$4 gdal=$5
  shift 5
  local run filter ours level finest=0 n
  while ((4 << finest < width)); do ((++finest)); done
  for ((run = 1; run <= runs; ++run)); do
    for filter in bilinear average; do
      ours=$filter
      level=$finest
      [ $filter = average ] && ours=area && level=$((finest - 1))
      n=$((1 << level))
      measure "$name, level $level" $filter globe $run "$work/planet" \
        "$globe" convert "$@" -o "$work/planet" --filter $ours --level $level --quiet
      local warp=(gdalwarp -q -overwrite -t_srs "$projection" -ts $((4 * n)) $((2 * n)) -r $filter -multi -wo NUM_THREADS=ALL_CPUS
        -co TILED=YES -co BLOCKXSIZE=128 -co BLOCKYSIZE=128 -co COMPRESS=DEFLATE -co ZLEVEL=1 -co NUM_THREADS=ALL_CPUS
        -co BIGTIFF=IF_SAFER)
      # shellcheck disable=SC2206
      warp+=($gdal "$source" "$work/warped.tif")
      measure "$name, level $level" $filter gdalwarp $run "$work/warped.tif" "${warp[@]}"
      measure "$name, level $level" $filter exact $run "$work/warped.tif" "${warp[@]}" -et 0
      local factors=() factor
      for ((factor = 2; 4 * n / factor >= 64; factor *= 2)); do factors+=($factor); done
      # shellcheck disable=SC2016
      measure "$name, level $level" $filter overviews $run "$work/warped.tif" \
        bash -c 'count=$1; shift; "${@:1:count}" && shift "$count" && gdaladdo -q -r average --config COMPRESS_OVERVIEW DEFLATE \
          --config PREDICTOR_OVERVIEW "$1" --config ZLEVEL_OVERVIEW 1 --config GDAL_NUM_THREADS ALL_CPUS "${@:2}"' \
        warp ${#warp[@]} "${warp[@]}" "${gdal##*PREDICTOR=}" "$work/warped.tif" "${factors[@]}"
      echo "convert_speed.sh: $name, $filter, run $run of $runs" >&2
    done
  done
}

place() {  # in out west srs: gives a map the frame that gdalwarp needs; globe reads the original
  gdal_translate -q -of VRT -a_ullr "$3" 90 "$(($3 + 360))" -90 -a_srs "$4" "$1" "$2"
}
earth=EPSG:4326 moon='+proj=longlat +R=1737400 +no_defs'
float='-ot Float32 -co PREDICTOR=3' byte='-co PREDICTOR=2'

if [ -f "$data/moon/moon_gld100_12.8ppd_int16.tif" ]; then
  place "$data/moon/moon_gld100_12.8ppd_int16.tif" "$work/moon.vrt" 0 "$moon"
  compare "Moon, 4608x2304 int16" "$work/moon.vrt" 4608 '+proj=cea +lon_0=180 +R=1737400' "$float" \
    "$data/moon/moon_gld100_12.8ppd_int16.tif" --extent 0,-90,360,90 --ellipsoid moon
fi
color=$data/earth/earth_colour_bluemarble_200411_topo_bathy_5400x2700.jpg
if [ -f "$color" ]; then
  place "$color" "$work/color.vrt" -180 $earth
  compare "Earth, 5400x2700 RGB JPEG" "$work/color.vrt" 5400 '+proj=cea +datum=WGS84' "$byte" --color "$color"
fi
width=${synthetic%x*}
if [ "$width" -gt 0 ]; then
  made=$work/made-$synthetic.tif
  if [ ! -f "$made" ]; then
    echo "convert_speed.sh: making $made (minutes)" >&2
    "$globe" export procedural -o "$work/float.tif" --size "$synthetic" --layer height --overwrite --quiet
    gdal_translate -q -ot Int16 -co TILED=YES -co COMPRESS=DEFLATE -co PREDICTOR=2 -co NUM_THREADS=ALL_CPUS \
      "$work/float.tif" "$made.partial.tif"
    mv "$made.partial.tif" "$made"
    rm -f "$work/float.tif"
  fi
  compare "made up, $synthetic int16" "$made" "$width" '+proj=cea +datum=WGS84' "$float" "$made"
fi
rm -rf "$work/planet" "$work/warped.tif" "$work/time" "$work/errors"

echo "gdalwarp $(gdalinfo --version), $(nproc) threads of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $runs runs each, in turns"
echo
echo "| source | filter | globe, s (median, 95 %) | gdalwarp, s | times as fast | exact, s | times as fast | overviews, s | times as fast | globe, Mpixel/s | peak, MB: globe | gdalwarp | output, MB: globe | gdalwarp |"
echo "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
# The interval of the median by the ranks that hold it with 95 % or more; the lowest and highest where runs are few.
tail -n +2 "$csv" | sort -t';' -k1,1 -k2,2 -k3,3 -k5,5n | awk -F';' '
  function choose(n, k, c, i) { c = 1; for (i = 1; i <= k; ++i) c = c * (n - k + i) / i; return c }
  function median(key, n) { n = count[key]; return n % 2 ? value[key, (n + 1) / 2] : (value[key, n / 2] + value[key, n / 2 + 1]) / 2 }
  function interval(key, n, k, outside) {
    n = count[key]
    for (k = 0; outside + 2 * choose(n, k) / 2 ^ n <= 0.05 && k < n / 2; ++k) outside += 2 * choose(n, k) / 2 ^ n
    if (k < 1) k = 1
    return sprintf("%.2f (%.2f to %.2f)", median(key), value[key, k], value[key, n + 1 - k])
  }
  { key = $1 ";" $2 ";" $3; value[key, ++count[key]] = $5; if ($7 > peak[key]) peak[key] = $7; bytes[key] = $8; seen[$1 ";" $2] = 1 }
  END {
    for (row in seen) {
      split(row, part, ";"); match(part[1], /[0-9]+x[0-9]+/); split(substr(part[1], RSTART, RLENGTH), size, "x")
      a = row ";globe"; b = row ";gdalwarp"; e = row ";exact"; o = row ";overviews"
      printf "| %s | %s | %s | %s | %.2f | %s | %.2f | %s | %.2f | %.1f | %.0f | %.0f | %.1f | %.1f |\n", part[1], part[2], \
        interval(a), interval(b), median(b) / median(a), interval(e), median(e) / median(a), interval(o), median(o) / median(a), size[1] * size[2] / 1e6 / median(a), peak[a] / 1024, peak[b] / 1024, bytes[a] / 1e6, bytes[b] / 1e6
    }
  }' | sort
