#!/bin/sh
# Examples 1 and 3 of the paper, and Example 2 at 2 and 10 m/s, with 50 and 100 m/s beside them: crushes of minutes to
# hours, one after another. Each leaves a row of FOLDER/slow_half.csv, its curve and its frames; what has its row is
# left out, so that the script can be stopped and resumed. Names choose some of them; `list` tells all.
#   tests/validation/slow_half.sh build/ci/bin/validate FOLDER [NAME ...]
#   tests/validation/slow_half.sh list
set -eu
validate=$1
if [ "$validate" = list ]; then
  wanted= folder= table=
else
  folder=$2 table=$2/slow_half.csv
  shift 2
  wanted=" $* "
  mkdir -p "$folder"
fi

# run NAME PRESET [name=value ...]
run() {
  name=$1
  shift
  if [ "$validate" = list ]; then
    echo "$name: validate $*"
    return
  fi
  case $wanted in "  " | *" $name "*) ;; *) return ;; esac
  if [ -f "$table" ] && grep -q "^validate $*," "$table"; then
    echo "$name: done already"
    return
  fi
  echo "$name"
  "$validate" "$@" table="$table" curve="$folder/$name.csv" frames="$folder/$name.frames" >"$folder/$name.txt" ||
    echo "$name: stopped before its end, see $folder/$name.txt"
}

default_elements="formulation=force_based depth_rule=full_moment"
for dimensions in 1 2; do
  run example-1-dimensions-$dimensions-papers-elements papka-kyriakides-$dimensions end_strain=0.85
  # shellcheck disable=SC2086
  run example-1-dimensions-$dimensions-default-elements papka-kyriakides-$dimensions end_strain=0.85 $default_elements
done
for speed in 10 50 100; do run type-i-$speed type-i speed=$speed frame_count=40; done
run type-i-2 type-i speed=2 end_strain=0.3 frame_count=40 # it has tipped over by then
# crush_inclusions NAME LINES [name=value ...]: with the friction of Example 1 at the plates, as the presets have it.
crush_inclusions() {
  name=$1 lines=$2
  shift 2
  end_strain=0.85
  if [ "$lines" = 6 ]; then end_strain=0.65; fi # the rigid cells lock at 66 %
  run "$name" "inclusions-$lines" end_strain=$end_strain samples=2000 frame_count=40 "$@"
}
for lines in 0 2 6; do crush_inclusions inclusions-$lines $lines plate_friction=0.2; done
crush_inclusions inclusions-0-frictionless 0 plate_friction=0
run type-i-2-plate-friction type-i speed=2 frame_count=40 plate_friction=0.2
# Elements per wall: as many as an hour or two allows.
crush_types() {
  speed=$1 elements=$2
  for type in ii iii; do
    run type-$type-as-counted-$speed type-$type-as-counted speed=$speed elements=$elements end_strain=0.45 \
      frame_count=40
  done
}
crush_types 10 8
crush_types 2 4
