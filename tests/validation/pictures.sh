#!/bin/sh
# Draws what slow_half.sh has left in FOLDER: strips like Figures 17, 19, 20 and 26 to 28 of the paper, charts like
# Figures 18, 21, 24 and 25, and courses.csv with densification and salient peaks. Crushes that are not there are left
# out.
#   tests/validation/pictures.sh build/ci/bin/validation_report FOLDER [PICTURES]
set -eu
report=$1
folder=$2
pictures=${3:-$2}
others=$(dirname "$0")/example_2.csv
mkdir -p "$pictures"

# strip NAME STRAINS TITLE
strip() {
  if [ -f "$folder/$1.frames" ]; then "$report" strip "$pictures/$1.png" strains="$2" "$folder/$1.frames=$3"; fi
}

# curves PICTURE ALONG FILE=TITLE ...: of those files that are there
curves() {
  picture=$1 along=$2
  shift 2
  count=$#
  while [ "$count" -gt 0 ]; do
    file=${1%%=*}
    if [ -f "$file" ]; then set -- "$@" "$1"; fi
    shift
    count=$((count - 1))
  done
  if [ $# -gt 0 ]; then "$report" curves "$pictures/$picture" along="$along" "$@"; fi
}

for speed in 2 10 50 100; do
  strip type-i-$speed 0.05,0.1,0.2,0.4 "$speed m/s"
  for type in ii iii; do
    for reading in as-counted as-stated; do strip type-$type-$reading-$speed 0.05,0.1,0.2,0.4 "$speed m/s"; done
  done
done
strip type-i-2-plate-friction 0.05,0.1,0.2,0.4 "2 m/s"
for lines in 0 2 6; do
  strip inclusions-$lines 0.13,0.25,0.4,0.55,0.7 ""
  strip inclusions-$lines-plate-friction 0.13,0.25,0.4,0.55,0.7 ""
done

curves type-i-slow.svg strain "$folder/type-i-2.csv=2 m/s" \
  "$folder/type-i-2-plate-friction.csv=2 m/s, friction 0.2 at the plates" "$folder/type-i-10.csv=10 m/s"
curves inclusions-0.svg travel "$folder/inclusions-0.csv=no inclusions" \
  "$folder/inclusions-0-seed-2.csv=imperfections of 0.001 mm, seed 2" "$folder/inclusions-0-seed-3.csv=seed 3"
curves inclusions-2.svg travel "$folder/inclusions-0.csv=no inclusions" "$folder/inclusions-2.csv=2 lines"
curves inclusions-6.svg travel "$folder/inclusions-0.csv=no inclusions" "$folder/inclusions-6.csv=6 lines"
curves inclusions-plate-friction.svg travel "$folder/inclusions-0-plate-friction.csv=no inclusions" \
  "$folder/inclusions-2-plate-friction.csv=2 lines" "$folder/inclusions-6-plate-friction.csv=6 lines"
curves inclusions-step.svg travel "$folder/inclusions-0.csv=chosen step" \
  "$folder/inclusions-0-papers-step.csv=step of 2e-8 s"

tables=$others,$folder/slow_half.csv
"$report" theory "$pictures/type-i-plateaus.svg" tables="$tables" type-i
"$report" fits "$pictures/plateaus-as-counted.svg" tables="$tables" type-i type-ii-as-counted type-iii-as-counted
"$report" fits "$pictures/plateaus-as-stated.svg" tables="$tables" type-i type-ii-as-stated type-iii-as-stated
"$report" courses "$folder"/inclusions-*.csv >"$pictures/courses.csv"
