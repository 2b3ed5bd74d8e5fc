#!/usr/bin/env bash
# site.sh DIRECTORY MORTISE [--headers]: builds the site of this documentation in DIRECTORY/site by mkdocs, without a
# network, with the parameters that the program MORTISE prints; --headers adds the headers by Doxygen.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,3s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2; }
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mortise=$(realpath "$2")
headers=${3:-}
mkdir -p "$1"
cd "$1"
rm -rf pages site
mkdir pages
cp "$top/README.md" "$top/LICENSE" "$top/CITATION.cff" pages
cp -r "$top/doc" pages
rm -f pages/doc/mkdocs.yml
# sources that pages name
grep -rhoE '\]\((\.\./)+(include|prm|source|tests)/[^)#]+' "$top/doc" --include='*.md' | sed -E 's#^\]\((\.\./)+##' | sort -u | while read -r file; do
  mkdir -p "pages/$(dirname "$file")"
  cp "$top/$file" "pages/$file"
done
{
  echo "# Parameters"
  echo
  echo 'What `mortise --parameters` prints.'
  echo
  "$mortise" --parameters | sed 's/^/    /'
} >pages/doc/parameters.md
cp "$top/doc/mkdocs.yml" mkdocs.yml
if [ "$headers" = --headers ]; then
  cat >Doxyfile <<END
PROJECT_NAME = Mortise
INPUT = $top/include/mortise
RECURSIVE = YES
STRIP_FROM_PATH = $top/include
EXTRACT_ALL = YES
JAVADOC_AUTOBRIEF = YES
GENERATE_LATEX = NO
OUTPUT_DIRECTORY = pages/doc
HTML_OUTPUT = headers
QUIET = YES
WARNINGS = NO
HAVE_DOT = NO
END
  doxygen Doxyfile
  printf '\n[Headers](headers/index.html), by Doxygen.\n' >>pages/doc/architecture.md
fi
mkdocs build --quiet --strict --config-file mkdocs.yml
# a reader without a network
if grep -rlE '<(script|link|img)[^>]*(src|href)="(https?:)?//' site --include='*.html' | grep -v /headers/ | head -n 1 | grep .; then
  echo "site.sh: this page loads something from the network" >&2
  exit 1
fi
