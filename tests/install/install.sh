#!/usr/bin/env bash
# install.sh BUILD_DIRECTORY TEST_DIRECTORY COMPILER: what `cmake --install` gives runs from another place, and
# programs of others compile with it, found by CMake and by pkg-config.
set -euo pipefail
build=$1 tests=$2 compiler=$3
fail() {
  echo "FAILED  $*"
  exit 1
}
cmake --install "$build" --prefix "$PWD/first" --strip >install.log
mv first there # nothing in it knows where it was
mortise=$PWD/there/bin/mortise
[ -s there/share/doc/mortise/README.md ] || fail "no documentation"
mkdir scene
cd scene
"$mortise" --version
"$mortise" --example | grep -q '^patch  *Patch test' || fail "--example does not list the patch test"
# one with a mesh that belongs to a scene that it includes
"$mortise" --example fichera_adaptive
[ "$(LC_ALL=C ls | xargs)" = "fichera.prm fichera_adaptive.prm l_shape.msh" ] || fail "--example wrote $(ls)"
"$mortise" --validate fichera_adaptive.prm >/dev/null || fail "the example is no valid scene"
code=0
rm fichera_adaptive.prm
echo mine >fichera.prm
message=$("$mortise" --example fichera_adaptive 2>&1) || code=$?
[ $code = 2 ] && [[ $message == *fichera.prm*l_shape.msh* ]] || fail "--example over a file: exit code $code, $message"
[ "$(cat fichera.prm)" = mine ] && [ ! -e fichera_adaptive.prm ] || fail "--example wrote beside what was there"
code=0
message=$("$mortise" --example pach 2>&1) || code=$?
[ $code = 2 ] && [[ $message == *'did you mean "patch"'* ]] || fail "an unknown example: exit code $code, $message"
"$mortise" --example patch
"$mortise" patch.prm >/dev/null || fail "an example does not run"
cd ..

export PKG_CONFIG_PATH=$(dirname "$(find "$PWD/there" -name mortise.pc)")
read -ra flags <<<"$(pkg-config --cflags mortise)"
read -ra libraries <<<"$(pkg-config --libs mortise)"
"$compiler" "${flags[@]}" "$tests/external_expression.cc" -o expression "${libraries[@]}" || fail "a program that finds the library by pkg-config"
[ "$(./expression)" = 10 ] || fail "the program that found the library by pkg-config gives $(./expression)"
cmake -S "$tests/project" -B project -DCMAKE_PREFIX_PATH="$PWD/there" -DCMAKE_CXX_COMPILER="$compiler" >cmake.log
cmake --build project >>cmake.log || { cat cmake.log; fail "a program that finds the library by CMake"; }
project/external scene/patch.prm >log || { cat log; fail "the program that found the library by CMake does not run"; }
[ -s results/external/summary.json ] || fail "the program that found the library by CMake writes nothing"
