#!/usr/bin/env bash
# source_version_test.sh CMAKE SCRIPT: what version() becomes as sources change.
set -euo pipefail
cmake=$1 script=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; exit 1; }

root="$work/a folder"
mkdir -p "$root/common/varimap/mesh" "$root/stages/eigen"
echo 'int one;' >"$root/common/varimap/mesh/one.h"
echo 'int main() {}' >"$root/stages/eigen/main.cpp"

version() {
    "$cmake" -D VERSION=1.2.3 -D ROOT="$1" -D OUTPUT="$work/version.cpp" -P "$script"
    sed -n 's/.*return "\(.*\)";/\1/p' "$work/version.cpp"
}

first=$(version "$root")
[[ $first =~ ^1\.2\.3\+[0-9a-f]{8}$ ]] || fail "not a number and a hash: $first"

cp -r "$root" "$work/elsewhere"
echo 'not a source' >"$work/elsewhere/stages/eigen/README.md"
[[ $(version "$work/elsewhere") == "$first" ]] || fail "the folder, or what is no source, changes the version"

echo 'int two;' >"$root/common/varimap/mesh/one.h"
[[ $(version "$root") != "$first" ]] || fail "a changed source leaves the version"
echo 'int one;' >"$root/common/varimap/mesh/one.h"
[[ $(version "$root") == "$first" ]] || fail "a source changed back does not"
mv "$root/common/varimap/mesh/one.h" "$root/stages/eigen/one.h"
[[ $(version "$root") != "$first" ]] || fail "a source that moves leaves the version"
