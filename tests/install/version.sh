#!/usr/bin/env bash
# version.sh VERSION PROGRAM SOURCE_DIRECTORY: the program, CITATION.cff and the page of changes have the version
# that CMakeLists.txt gives the project.
set -u
version=$1 program=$2 top=$3 wrong=0
# same WHAT FOUND
same() {
  [ "$2" = "$version" ] || { echo "FAILED  $1 has version \"$2\", CMakeLists.txt has $version"; wrong=1; }
}
same "mortise --version" "$("$program" --version | awk '{ print $2 }')"
same CITATION.cff "$(sed -n 's/^version: *//p' "$top/CITATION.cff")"
same doc/CHANGELOG.md "$(grep -o -m 1 'version [0-9][0-9.]*[0-9]' "$top/doc/CHANGELOG.md" | cut -d' ' -f2)"
same doc/install/spack/package.py "$(sed -n 's/^    version("\([0-9.]*\)".*/\1/p' "$top/doc/install/spack/package.py" | head -n 1)"
exit $wrong
