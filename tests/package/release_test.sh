#!/usr/bin/env bash
# Makes releases in a clone with commits of its own: version, citation, changelog and tag; and what is refused.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@example.org
export GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@example.org

expect() {  # expect WHAT IS WANTED
  [[ $2 == "$3" ]] || { echo "$1 is \"$2\", not \"$3\""; exit 1; }
}
refused() {  # refused WORDS ARGUMENT...
  local words=$1 output
  shift
  if output=$(deploy/release --no-packages "$@" 2>&1); then echo "not refused: $*"; exit 1; fi
  [[ $output == *"$words"* ]] || { echo "refused with \"$output\", not with \"$words\""; exit 1; }
}
change() {
  echo "$RANDOM" >>README.md
  git commit -qam "$1"
}

mkdir "$folder/deploy"
cp "$root"/{CMakeLists.txt,CITATION.cff,README.md} "$folder"
cp "$root"/deploy/{common.sh,release} "$folder/deploy"
printf '# Changelog\n\nHow it is made.\n' >"$folder/CHANGELOG.md"
cd "$folder"
git init -q
git add .
git commit -qm "core: the first step"
change "server: a daemon"
change "core: the second step"

refused "usage:" 2.0
deploy/release --no-packages 20.1.0 >/dev/null
expect "the tag" "$(git describe)" v20.1.0
expect "the version" "$(sed -n 's/^project(cellcrush VERSION \([^ ]*\).*/\1/p' CMakeLists.txt)" 20.1.0
expect "the cited version" "$(sed -n 's/^version: //p' CITATION.cff)" 20.1.0
expect "the changelog" "$(sed 's/, 20..-..-..$//' CHANGELOG.md | tr '\n' '/')" \
  "# Changelog//How it is made.//## 20.1.0//### core//* the first step/* the second step//### server//* a daemon/"

change "docs: more words"
refused "is older" 20.0.9
deploy/release --no-packages 20.2.0 >/dev/null
expect "the sections" "$(grep '^##' CHANGELOG.md | sed 's/, .*//' | tr '\n' ' ')" \
  "## 20.2.0 ### docs ## 20.1.0 ### core ### server "
expect "the notes of the tag" \
  "$(git tag -l --format='%(contents:body)' v20.2.0 | tr '\n' '/')" "### docs//* more words//"
expect "dates of the release" "$(grep -c ^date-released CITATION.cff)" 1
refused "Nothing was committed" 20.3.0
echo x >>README.md
refused "not committed" 20.4.0
