#!/bin/sh
# Example 2 of the paper at 25 to 200 m/s to 45 % strain: 26 crushes, one after another, about half an hour of one core.
#   tests/validation/example_2.sh build/ci/bin/validate example_2.csv
set -eu
validate=$1
table=$2
run() {
  elements=2
  case $1 in type-i) elements= ;; esac # its default
  "$validate" "$1" speed="$2" ${elements:+elements=$elements} end_strain=0.45 table="$table" >/dev/null
}
for speed in 200 100 50 25; do
  for preset in type-i type-ii-as-counted type-iii-as-counted; do run "$preset" "$speed"; done
done
for preset in type-ii-as-stated type-iii-as-stated; do
  for speed in 100 50 25 200; do run "$preset" "$speed"; done
done
for speed in 150 75; do
  for preset in type-i type-ii-as-counted type-iii-as-counted; do run "$preset" "$speed"; done
done
