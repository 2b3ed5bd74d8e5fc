#!/usr/bin/env bash
# pictures.sh MORTISE [SCENE]...: run scenes of prm/ (default: all) and render each into
# doc/pictures/. Called by `./run pictures`. Needs python3 with pyvista (pip install pyvista).
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mortise=$1
shift
scenes=("$@")
[ ${#scenes[@]} -eq 0 ] && scenes=($(cd "$top/prm" && ls -- *.prm | sed 's/\.prm$//'))
python3 -c 'import pyvista' 2>/dev/null || { echo "pictures need pyvista: pip install pyvista" >&2; exit 1; }
mkdir -p "$top/doc/pictures"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
show=()
[ -z "${DISPLAY:-}" ] && command -v xvfb-run >/dev/null && show=(xvfb-run -a)
for scene in "${scenes[@]}"; do
  "$mortise" --output "$work/$scene" --set "Output/Fields=displacement, stress, traction, degree" "$top/prm/$scene.prm" >"$work/$scene.log"
  "${show[@]}" python3 "$top/doc/pictures.py" "$work/$scene" "$top/doc/pictures/$scene.png"
  echo "doc/pictures/$scene.png"
done
