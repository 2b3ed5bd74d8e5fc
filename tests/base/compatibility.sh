#!/bin/bash
# compatibility.sh SOURCE_DIRECTORY: names that not all supported versions of deal.II have stand in
# include/mortise/base/compatibility.h alone, so that a build with the one version says what the other would.
cd "$1" || exit 1
names='std_cxx1[0-9]|std_cxx20|DEAL_II_VERSION_GTE'
found=$(grep -rnE "$names" include source tests --include='*.h' --include='*.cc' | grep -v '^include/mortise/base/compatibility.h:')
grep -qE "$names" include/mortise/base/compatibility.h || found="compatibility.h has none of them"
[ -z "$found" ] || { echo "$found"; exit 1; }
