#!/bin/sh
# Presets of other papers than that of Wu, Tsai and Lee (RESULTS.md): crushes of seconds to a minute, one after another.
# Each appends a row to TABLE; what has its row is left out.
#   tests/validation/published.sh build/ci/bin/validate TABLE
set -eu
validate=$1 table=$2

run() {
  if [ -f "$table" ] && grep -q "^validate $*," "$table"; then return; fi
  "$validate" "$@" table="$table" >/dev/null
}

for speed in 3.5 14 70; do
  for seed in 1 2 3; do run ruan-2003 speed=$speed end_strain=0.6 seed=$seed; done
done
for speed in 20 50 100; do
  for irregularity in 0 0.5; do run zheng-2005 speed=$speed end_strain=0.41 irregularity=$irregularity; done
done
for thickness in 1.5 1 0.5; do
  run ajdari-2011-graded end_strain=0.2 amplitude=0.01 thickness_at_impact=$thickness
done
for direction in x y; do run gibson-1982-reentrant direction=$direction amplitude=0.04 end_strain=0.41; done
