#!/usr/bin/env bash
# site.sh SOURCE_DIRECTORY MORTISE: the site of the documentation builds without a warning, in the current directory.
command -v mkdocs >/dev/null || { echo "skipped: there is no mkdocs here (Debian: mkdocs)"; exit 77; }
"$1/doc/site.sh" . "$2" && [ -s site/doc/parameters.html ] && [ -s site/doc/tutorials/1_tie.html ]
