#!/bin/sh
# Draws what slow_half.sh has left in FOLDER: strips like Figures 17, 19, 20 and 26 to 28 of the paper, charts like
# Figures 18, 21, 24 and 25. Crushes that have not come to their end are left out, and strips of those without frames.
# The charts of plateaus also have the crushes of example_2.csv.
#   tests/validation/pictures.sh build/ci/bin/validation_report FOLDER [PICTURES]
set -eu
report=$1
folder=$2
pictures=${3:-$2}
example_2=$(dirname "$0")/example_2.csv
mkdir -p "$pictures"

# Whether a crush has come to its end.
has() { grep -q ",$1.csv," "$folder/slow_half.csv"; }

# strip NAME STRAINS TITLE
strip() {
  if has "$1" && [ -f "$folder/$1.frames" ]; then
    "$report" strip "$pictures/$1.png" strains="$2" "$folder/$1.frames=$3"
  fi
}

# curves PICTURE ALONG NAME=TITLE ...
curves() {
  picture=$1 along=$2
  shift 2
  count=$#
  while [ "$count" -gt 0 ]; do
    if has "${1%%=*}"; then set -- "$@" "$folder/${1%%=*}.csv=${1#*=}"; fi
    shift
    count=$((count - 1))
  done
  if [ $# -gt 0 ]; then "$report" curves "$pictures/$picture" along="$along" "$@"; fi
}

strip type-i-2 0.05,0.1,0.2,0.27 "2 m/s"
for speed in 10 50 100; do strip type-i-$speed 0.05,0.1,0.2,0.4 "$speed m/s"; done
for speed in 2 10; do
  for type in ii iii; do strip type-$type-as-counted-$speed 0.05,0.1,0.2,0.4 "$speed m/s"; done
done
strip type-i-2-plate-friction 0.05,0.1,0.2,0.4 "2 m/s"
for name in inclusions-0 inclusions-2 inclusions-0-frictionless; do strip $name 0.13,0.25,0.4,0.55,0.7 ""; done
strip inclusions-6 0.13,0.25,0.4,0.55,0.65 ""

curves type-i-slow.svg strain "type-i-2=2 m/s" \
  "type-i-2-plate-friction=2 m/s, friction 0.2 at the plates" "type-i-10=10 m/s"
curves inclusions-0.svg travel "inclusions-0=no inclusions" \
  "inclusions-0-frictionless=no friction at the plates"
curves inclusions-2.svg travel "inclusions-0=no inclusions" "inclusions-2=2 lines"
curves inclusions-6.svg travel "inclusions-0=no inclusions" "inclusions-6=6 lines"

"$report" theory "$pictures/type-i-plateaus.svg" tables="$example_2,$folder/slow_half.csv" type-i/2
"$report" fits "$pictures/plateaus-seeds.svg" tables="$example_2" type-i/2 type-ii-as-counted/8 \
  type-iii-as-counted/8
