#!/usr/bin/env bash
# Proves that wrong input ends with exit code 2 and one message that says what, on one and two
# ranks, and leaves no output directory; and that a solver that gives up ends with 3 and writes.
set -u
mortise=$1 batch=$2 prm=$3
work=$(mktemp -d)
trap 'kill "${processes[@]}" 2>/dev/null; wait; rm -rf "$work"' EXIT
passed=0 failed=0
mpi=$(dirname "${BASH_SOURCE[0]}")/../mpi.sh
mkdir "$work/said"

# Nearly all runs end in a tenth of the time that a process takes to start: one process, or two ranks, make them all.
declare -A processes requests answers
begin() {
  local ranks=$1
  rm -f "$work/requests$ranks" "$work/answers$ranks"
  mkfifo "$work/requests$ranks" "$work/answers$ranks"
  exec {requests[$ranks]}<>"$work/requests$ranks" {answers[$ranks]}<>"$work/answers$ranks"
  "$mpi" "$ranks" "$batch" "$work/requests$ranks" >"$work/answers$ranks" &
  processes[$ranks]=$!
}

# run RANKS ARGUMENT...: sets message and code
run() {
  local ranks=$1
  shift
  rm -rf "$work/out" "$work/said"/*
  if [ -n "${itself:-}" ]; then
    message=$("$mpi" "$ranks" "$mortise" "$@" 2>&1 >/dev/null)
    code=$?
    return
  fi
  [ -n "${processes[$ranks]:-}" ] || begin "$ranks"
  printf '%s\n' $# "$work/said" "$@" >&"${requests[$ranks]}"
  until read -r -t 1 -u "${answers[$ranks]}" code; do
    kill -0 "${processes[$ranks]}" 2>/dev/null && continue
    wait "${processes[$ranks]}" # the ranks ended each other
    code=$?
    unset "processes[$ranks]"
    break
  done
  message=$(cat "$work/said/err" 2>&1)
}

# expect CODE PATTERN ARGUMENT...
expect() {
  local expected=$1 pattern=$2 ranks message code
  shift 2
  for ranks in 1 2; do
    run $ranks --output "$work/out" "$@"
    if [ "$code" -ne "$expected" ]; then
      echo "FAILED  $* on $ranks ranks: exit code $code, expected $expected: $message"
    elif ! grep -q -i -e "$pattern" <<<"$message"; then
      echo "FAILED  $* on $ranks ranks: no \"$pattern\" in: $message"
    elif [ "$(grep -c -i -e "$pattern" <<<"$message")" -ne 1 ]; then
      echo "FAILED  $* on $ranks ranks: message printed more than once: $message"
    elif [ "$code" -eq 2 ] && [ -e "$work/out" ]; then
      echo "FAILED  $* on $ranks ranks: left an output directory"
    elif [ "$code" -eq 3 ] && [ ! -s "$work/out/summary.json" ]; then
      echo "FAILED  $* on $ranks ranks: wrote no summary"
    else
      passed=$((passed + 1))
      continue
    fi
    failed=$((failed + 1))
  done
}

# the same by the program itself
expect_itself() {
  local itself=1
  expect "$@"
}

# rigid parts
bar=$prm/../tests/field/bar_with_a_rigid_end.prm
expect 2 'Coupling.*one of: distributing, rigid' "$bar" --set 'Body bar/Boundary zmax/Coupling=stiff'
expect 2 'Displacement.*along the normal with Coupling = rigid' "$bar" --set 'Body bar/Boundary zmax/Displacement=normal: 0'
expect 2 'Displacement axes.*with Coupling = rigid' "$bar" --set 'Body bar/Boundary zmax/Displacement axes=0, 0, 30'
expect 2 'Normal stiffness.*with Coupling = rigid' "$bar" --set 'Body bar/Boundary zmax/Normal stiffness=1'
expect 2 'Rotation.*expression in t' "$bar" --set 'Body bar/Boundary zmax/Rotation=x; 0; 0'
expect 2 'Rotation.*"-".*expression in t' "$bar" --set 'Body bar/Boundary zmin/Rotation=-; 0; 0'
expect 2 'share vertices.*bar: zmax' "$bar" --set 'Body bar/Boundary ymin/Coupling=rigid'
expect 2 'bar: zmax differ by .* from the nearest rigid motion' "$bar" --set 'Body bar/Boundary ymin/Displacement=-, 0, 0.1*x^2'
expect 2 'arc length with a rigid part' "$bar" --set 'Body bar/Material/Law=neo-Hookean' --set 'Steps/Control=arc length' --set 'Steps/Step=0.5'
expect 2 'the body bar can move freely: translation along x, translation along y, translation along z' "$bar" --set 'Body bar/Boundary zmin/Displacement='
plate=$prm/../tests/field/column_under_a_tilting_plate.prm
expect 2 'Slave.*body plate with Law = rigid' "$plate" --set 'Interface seat/Slave=plate: zmin' --set 'Interface seat/Master=column: zmax'
expect 2 'Slave.*boundary zmax with Coupling = rigid' "$plate" --set 'Body column/Boundary zmax/Coupling=rigid'
expect 2 'Young modulus.*the body has Law = rigid' "$plate" --set 'Body plate/Material/Young modulus=1'
expect 2 'the body plate .* can move freely: translation along x' "$plate" --set 'Body plate/Boundary zmax/Displacement=-, 0, -'
expect 2 'body plate with Law = rigid.*Displacement along the axes' "$plate" --set 'Body plate/Boundary ymin/Displacement=normal: 0'

scene=$prm/patch.prm
expect 2 'Degree' "$scene" --set 'Body lower/Degre=2'
expect_itself 2 'Degree' "$scene" --set 'Body lower/Degre=2'
expect 2 'Degree' "$scene" --set 'Body lower/Degree=two'
expect 2 '1.*8' "$scene" --set 'Body lower/Degree=9'
expect 2 'not above 0.5' "$scene" --set 'Body lower/Material/Poisson ratio=0.51'
expect 2 'Exact solution/Pressure' "$scene" --set 'Body lower/Material/Poisson ratio=0.5' --set 'Body lower/Degree=2'
expect 2 'degree 1 in mixed form' "$scene" --set 'Body lower/Formulation=mixed' --set 'Body lower/Degree=1'
expect 2 'Young' "$scene" --set 'Body lower/Material/Young modulus=-1'
expect 2 'Young modulus.*got nothing with Law = linear elastic' "$scene" --set 'Body lower/Material/Young modulus='
expect 2 'Young moduli.*got 0' "$scene" --set 'Body lower/Material/Young modulus=' --set 'Body lower/Material/Law=orthotropic' \
  --set 'Body lower/Material/Poisson ratio=0.3'
expect 2 'lies outside of body "upper", whose nearest vertex' --validate "$scene" --set 'Output/Points=tip: upper: 9, 0.5, 0' \
  --set 'Adaptivity/Target error=0.1' --set 'Adaptivity/Quantity=tip, z'
expect 2 'lies outside of body "upper", whose nearest vertex' "$scene" --set 'Output/Points=tip: upper: 9, 0.5, 0' \
  --set 'Adaptivity/Target error=0.1' --set 'Adaptivity/Quantity=tip, z'
expect 2 'missing.msh' "$scene" --set 'Body lower/Mesh/Source=file' --set 'Body lower/Mesh/File=missing.msh' \
  --set 'Body lower/Mesh/Extent=' --set 'Body lower/Mesh/Subdivisions='
# broken and unsuitable mesh files; all kinds of damage are in tests/body/mesh_broken.cc
file=(--set 'Body lower/Mesh/Source=file' --set 'Body lower/Mesh/Extent=' --set 'Body lower/Mesh/Subdivisions=')
printf 'solid cube\n' >"$work/solid.msh"
: >"$work/empty.msh"
head -c 3000 /dev/urandom >"$work/noise.msh"
geometry=$prm/../meshes/thick_sphere_tet.geo
expect 2 'MeshFormat' "$scene" "${file[@]}" --set "Body lower/Mesh/File=$work/solid.msh"
expect_itself 2 'MeshFormat' "$scene" "${file[@]}" --set "Body lower/Mesh/File=$work/solid.msh"
# all faults of all meshes and names at once; what may be meant is told, and no error
cat >"$work/cracked.inp" <<'END'
*NODE
1,0,0,0
2,1,0,0
3,1,1,0
4,0,1,0
5,0,0,1
6,1,0,1
7,1,1,1
8,0,1,1
9,2,0,0
10,2,1,0
11,2,0,1
12,2,1,1
21,1,0,0
22,1,1,0
23,1,0,1
24,1,1,1
30,9,9,9
*ELEMENT, TYPE=C3D8, ELSET=all
1, 1,2,3,4,5,6,7,8
2, 21,9,10,22,23,11,12,24
*SURFACE, NAME=zmax
1, S2
END
sed 's/^2, .*/2, 2,9,10,3,6,11,12,7/' "$work/cracked.inp" >"$work/whole.inp"
for by in expect_itself expect; do
  validate=()
  [ "$by" = expect ] || validate=(--validate)
  for pattern in 'Body lower, Mesh: .*cracked.inp. has faults' 'error: pairs of nodes at one place.* 4, nodes 2 and 21 at' \
    'warning: nodes that no cell and no face has: 1, node 30 at (9, 9, 9)' 'Body upper, Mesh: .*missing.msh' \
    'body "lower" has no boundary "xmin"'; do
    "$by" 2 "$pattern" "${validate[@]}" "$scene" "${file[@]}" --set "Body lower/Mesh/File=$work/cracked.inp" \
      --set 'Body upper/Mesh/Source=file' --set 'Body upper/Mesh/Extent=' --set 'Body upper/Mesh/Subdivisions=' \
      --set 'Body upper/Mesh/File=missing.msh'
  done
done
told=$("$mortise" --validate "$scene" "${file[@]}" --set "Body lower/Mesh/File=$work/whole.inp" \
  --set "Body lower/Mesh/Boundaries=xmin: plane x = 0; ymin: plane y = 0; zmin: plane z = 0; xmax: plane x = 2; ymax: plane y = 1" 2>&1)
if [ $? -eq 0 ] && grep -q '^warning: body lower: nodes that no cell and no face has: 5, node 21 at (1, 0, 0)' <<<"$told"; then
  passed=$((passed + 1))
else
  echo "FAILED  warnings of a mesh that is valid: $told"
  failed=$((failed + 1))
fi
expect 2 'is empty' "$scene" "${file[@]}" --set "Body lower/Mesh/File=$work/empty.msh"
expect 2 'MeshFormat' "$scene" "${file[@]}" --set "Body lower/Mesh/File=$work/noise.msh"
expect 2 'it has: inner (tetrahedra), outer (tetrahedra)' "$scene" "${file[@]}" --set "Body lower/Mesh/File=$geometry" \
  --set 'Body lower/Mesh/Part=middle'
expect 2 'did you mean .inner inside' "$scene" "${file[@]}" --set "Body lower/Mesh/File=$geometry" \
  --set 'Body lower/Mesh/Curved boundaries=inner insid: sphere'
expect 2 'zmax' "$scene" --set 'Interface glue/Slave=lower: top'
expect 2 'each boundary once' "$scene" --set 'Interface glue/Slave=lower: zmax, zmax'
expect 2 'no boundary .zmux' "$scene" --set 'Interface glue/Slave=lower: zmax, zmux'
expect 2 'expression in t' "$scene" --set 'Interface glue/Preload=x'
glue='Interface glue/'
expect 2 'Translation.*got nothing with Periodic = translation' "$scene" --set "${glue}Periodic=translation"
expect 2 'Translation.*got zero' "$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=0, 0, 0"
expect 2 'Translation.*got .1, 0.' "$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=1, 0"
expect 2 'Rotation.*got nothing with Periodic = rotation' "$scene" --set "${glue}Periodic=rotation" --set "${glue}Reference point=0, 0, 0"
expect 2 'Rotation.*got zero' "$scene" --set "${glue}Periodic=rotation" --set "${glue}Rotation=0, 0, 0"
expect 2 'a rotation without Periodic = rotation' "$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=0, 0, 1" --set "${glue}Rotation=0, 0, 30"
expect 2 'a translation without Periodic' "$scene" --set "${glue}Translation=0, 0, 1"
expect 2 'a point without Periodic = rotation' "$scene" --set "${glue}Reference point=0, 0, 1"
expect 2 'a periodic interface with Law = slide' "$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=0, 0, 1" --set "${glue}Law=slide"
expect 2 'a preload of a periodic interface' "$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=0, 0, 1" --set "${glue}Preload=1"
expect 2 'Periodic.*got .turn.' "$scene" --set "${glue}Periodic=turn"
expect 2 'do not meet.*after the master is moved' "$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=0, 0, 1"
expect 2 'do not meet.*after the master is moved' "$scene" --set "${glue}Periodic=rotation" --set "${glue}Rotation=0, 0, 30" --set "${glue}Reference point=9, 0, 0"
expect 2 'where no interface has Periodic = translation' "$scene" --set 'Periodic cell/Mean strain=0; 0; 0.1; 0; 0; 0'
expect 2 'where no interface has Periodic = translation' "$scene" --set 'Periodic cell/Mean strain=free; 0; 0; 0; 0; 0' \
  --set "${glue}Periodic=rotation" --set "${glue}Rotation=0, 0, 30"
cell=("$scene" --set "${glue}Periodic=translation" --set "${glue}Translation=0, 0, 1")
expect 2 'more free components than the 1 different' "${cell[@]}" --set 'Periodic cell/Mean strain=free; 0; 0; 0; 0; 0'
expect 2 'Mean stress, component xx.*beside the Mean strain .0.' "${cell[@]}" --set 'Periodic cell/Mean stress=1; 0; 0; 0; 0; 0'
expect 2 'these are 3 components, not 6' "${cell[@]}" --set 'Periodic cell/Mean strain=1; 0; 0'
expect 2 'Mean strain.*component yz: got .x.' "${cell[@]}" --set 'Periodic cell/Mean strain=0; 0; 0; x; 0; 0'
material='Body lower/Material/'
expect 2 'Strain.*got small with Law = neo-Hookean' "$scene" --set "${material}Law=neo-Hookean" --set "${material}Strain=small"
expect 2 'Yield stress.*got nothing with Law = J2 plasticity' "$scene" --set "${material}Law=J2 plasticity"
expect 2 'softening is not supported' "$scene" --set "${material}Law=J2 plasticity" --set "${material}Yield stress=1" \
  --set "${material}Hardening modulus=-1"
expect 2 'Saturation exponent.*got nothing beside the other one' "$scene" --set "${material}Law=J2 plasticity" \
  --set "${material}Yield stress=1" --set "${material}Saturation stress=2"
expect 2 'Hardening table.*strains ascending from 0' "$scene" --set "${material}Law=J2 plasticity" \
  --set "${material}Hardening table=0, 1; 0.1, 0.9"
expect 2 'C10.*belongs to Law = Mooney-Rivlin' "$scene" --set "${material}C10=1"
expect 2 'Ogden terms.*got 1, -2' "$scene" --set "${material}Law=Ogden" --set "${material}Young modulus=" \
  --set "${material}Ogden terms=1, -2"
expect 2 'Pressure follows.*or a law of finite strain' "$scene" --set 'Body upper/Boundary zmax/Pressure=1' \
  --set 'Body upper/Boundary zmax/Pressure follows=true'
steps=(--set 'Steps/Control=arc length' --set 'Steps/Step=0.1')
expect 2 'Control.*with bodies of linear laws alone' "$scene" "${steps[@]}"
expect 2 'Control.*arc length with Law = contact of interface glue' "$scene" "${steps[@]}" --set "${material}Law=neo-Hookean" \
  --set 'Interface glue/Law=contact'
expect 2 'Steps/Step.*got several times with Control = arc length' "$prm/balloon.prm" "${steps[@]}" --set 'Steps/Step=0.1, 0.2' --set 'Steps/End time='
expect 2 'Number of steps.*got 3 with Control = load' "$scene" --set 'Steps/Number of steps=3'
expect 2 'where nothing that acts depends on t' "$prm/balloon.prm" "${steps[@]}" \
  --set 'Body inner/Boundary inside/Pressure=0.1'
expect 2 'Quantity.*with Law = J2 plasticity of body lower' "$scene" --set "${material}Law=J2 plasticity" --set "${material}Yield stress=1" \
  --set 'Adaptivity/Target error=0.1' --set 'Adaptivity/Quantity=p, z' --set 'Output/Points=p: lower: 0.5, 0.5, 0'
expect 2 'Control.*arc length with the Preload of interface glue' "$scene" "${steps[@]}" --set "${material}Law=neo-Hookean" \
  --set 'Interface glue/Preload=1'
expect 2 'Control.*arc length with free components' "${cell[@]}" "${steps[@]}" --set "${material}Law=neo-Hookean" \
  --set 'Periodic cell/Mean strain=0; 0; free; 0; 0; 0'
expect 2 'Control.*arc length with Adaptivity/Target error' "$prm/balloon.prm" "${steps[@]}" --set 'Adaptivity/Target error=0.1'
expect 2 'in mixed form with Poisson ratio 0.49' "$scene" --set "${material}Law=neo-Hookean" --set "${material}Poisson ratio=0.49" \
  --set 'Body lower/Degree=2' --set 'Exact solution/Displacement=x*y; 0; 0'
expect 2 'only Law = tie' "$scene" --set 'Interface glue/Preload=1' --set 'Interface glue/Law=slide'
expect 2 'Sliding.*finite with Law = spring' "$scene" --set 'Interface glue/Sliding=finite' --set 'Interface glue/Law=spring' \
  --set 'Interface glue/Normal stiffness=1' --set 'Interface glue/Tangential stiffness=1'
expect 2 'Sliding.*finite with Mesh gap = ignored' "$scene" --set 'Interface glue/Sliding=finite' --set 'Interface glue/Law=contact' --set 'Interface glue/Mesh gap=ignored' \
  --set 'Body lower/Material/Law=neo-Hookean'
expect 2 'a time without a Preload' "$scene" --set 'Interface glue/Preload until=1'
expect 2 'without Material/Thermal expansion' "$scene" --set 'Body upper/Temperature=20'
expect 2 'without Temperature' "$scene" --set 'Body upper/Material/Thermal expansion=1e-5'
expect 2 'no . or ..' "$scene" --set 'Bodies=lower, upper, ..'
for i in $(seq 30); do echo "subsection a"; done >"$work/deep.prm"
expect 2 'nested more than 20 deep' "$work/deep.prm"
expect 2 'more than 200 deep' "$scene" --set "Body upper/Body force=0; 0; $(printf '(%.0s' $(seq 201))1$(printf ')%.0s' $(seq 201))"
expect 2 'an expression in t' "$scene" --set 'Body upper/Boundary zmax/Force=x; 0; 0'
expect 2 'component y.*an expression in t' "$scene" --set 'Body upper/Boundary zmax/Moment=0; exact; 0'
expect 2 'Displacement.*got "normal"' "$scene" --set 'Body upper/Boundary zmin/Displacement=normal'
expect 2 'is not known' "$scene" --set 'Body upper/Boundary xmin/Displacement=normal: y_'
expect 2 'axes for no components' "$scene" --set 'Body upper/Boundary zmax/Displacement axes=10, 0, 0'
expect 2 'exact.*with Displacement axes' "$scene" --set 'Body lower/Boundary xmin/Displacement axes=10, 0, 0'
expect 2 'which has a prescribed displacement' "$scene" --set 'Body lower/Boundary zmax/Displacement=normal: 0' --set 'Body upper/Boundary zmin/Displacement=normal: 0'
expect 2 'Density' "$scene" --set 'Gravity=0; 0; -9.81'
expect 2 'Density.*got -1' "$scene" --set 'Body upper/Material/Density=-1'
expect 2 'same' "$scene" --set 'Interface glue/Master=lower: zmax'
expect 2 'Law .*did you mean "slide"' "$scene" --set 'Interface glue/Law=glide'
expect 2 'Normal stiffness: got nothing with Law = spring' "$scene" --set 'Interface glue/Law=spring' \
  --set 'Interface glue/Tangential stiffness=1'
expect 2 'allowed: a positive stiffness' "$scene" --set 'Interface glue/Law=spring' \
  --set 'Interface glue/Normal stiffness=-1' --set 'Interface glue/Tangential stiffness=1'
expect 2 'only Law = spring has stiffnesses' "$scene" --set 'Interface glue/Tangential stiffness=1'
expect 2 'Friction coefficient.*it belongs to Law = contact' "$scene" --set 'Interface glue/Friction coefficient=0.3'
expect 2 'Friction coefficient.*a number that is not negative' "$scene" --set 'Interface glue/Law=contact' \
  --set 'Interface glue/Friction coefficient=-0.3'
expect 2 'Friction coefficient.*allowed: values that are not negative' "$scene" --set 'Interface glue/Law=contact' \
  --set 'Interface glue/Friction coefficient=0.01*(x - 0.5)'
expect 2 'a coefficient without a Friction coefficient' "$scene" --set 'Interface glue/Law=contact' \
  --set 'Interface glue/Static friction coefficient=0.3'
expect 2 'Friction bound.*nothing with Law = tresca' "$scene" --set 'Interface glue/Law=tresca'
expect 2 'Friction bound.*it belongs to Law = tresca' "$scene" --set 'Interface glue/Law=contact' \
  --set 'Interface glue/Friction bound=1'
expect 2 'Solver/Friction.*did you mean "fixed point"' "$scene" --set 'Solver/Friction=fixed-point'
expect 2 'Mesh gap.*did you mean "ignored"' "$scene" --set 'Interface glue/Law=contact' --set 'Interface glue/Mesh gap=ignore'
expect 2 'Offset .*is inf at' "$scene" --set 'Interface glue/Offset=1/(x-x)'
# bodies that slide across an edge that ends within a smooth surface
cat >"$work/corner.geo" <<'END'
Point(1) = {0, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 0.3, 0}; Point(4) = {0, 1, 0};
Point(5) = {0, -1, 1}; Point(6) = {1, -1, 1}; Point(7) = {1, 0, 1}; Point(8) = {1, 0.3, 0.4};
Point(9) = {0, 1, 1}; Point(10) = {0, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 10}; Line(10) = {10, 5};
Line(11) = {10, 7}; Line(12) = {1, 5}; Line(13) = {2, 6}; Line(14) = {3, 8}; Line(15) = {4, 9};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {1, 13, -5, -12}; Plane Surface(2) = {2};
Curve Loop(3) = {2, 14, -7, -6, -13}; Plane Surface(3) = {3};
Curve Loop(4) = {3, 15, -8, -14}; Plane Surface(4) = {4};
Curve Loop(5) = {4, 12, -10, -9, -15}; Plane Surface(5) = {5};
Curve Loop(6) = {5, 6, -11, 10}; Plane Surface(6) = {6};
Curve Loop(7) = {11, 7, 8, 9}; Surface(7) = {7};
Surface Loop(1) = {1, 2, 3, 4, 5, 6, 7}; Volume(1) = {1};
MeshSize{:} = 0.3;
Physical Volume("corner") = {1};
Physical Surface("bottom") = {1};
Physical Surface("outside") = {6, 7};
END
cat >"$work/corner.prm" <<'END'
set Bodies = corner, top
set Interfaces = glue
subsection Body corner
  subsection Mesh
    set Source = file
    set File = corner.geo
  end
  subsection Material
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
  subsection Boundary bottom
    set Displacement = 0, 0, 0
  end
end
subsection Body top
  subsection Mesh
    set Source = box
    set Extent = 0, -1, 1, 1, 0, 2
    set Subdivisions = 3, 3, 2
  end
  subsection Material
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
  subsection Boundary zmax
    set Displacement = 0, 0, -0.1
  end
end
subsection Interface glue
  set Slave = corner: outside
  set Master = top: zmin
  set Law = slide
end
subsection Output
  set Directory = out
end
END
expect 2 'slide across an edge of corner: outside at ' "$work/corner.prm"
expect 2 'which is also a body' "$scene" --set 'Interfaces=glue, lower' --set 'Interface lower/Slave=lower: xmax' \
  --set 'Interface lower/Master=upper: xmax'
# a body that hangs by nothing, and one that a single point of constants would hold
expect 2 'upper.*can move freely: rotation about x' "$prm/floating.prm" --set 'Body upper/Mesh/Translate=0.99,0,0' \
  --set 'Exact solution/Displacement=x/9; -y/36; -z/36'
expect 2 'do not meet' "$scene" --set 'Body upper/Mesh/Translate=0, 0, 5'
expect 2 'rigid motions.*translation along z' "$scene" --set 'Body lower/Boundary zmin/Displacement=-, -, -'
expect 2 'missing.prm' "$work/missing.prm"
expect_itself 2 'missing.prm' "$work/missing.prm"
echo plain >"$work/file"
expect 2 'file' "$scene" --set "Output/Directory=$work/file/results"
# numbers that are none, where they are evaluated; see tests/problem/parameters_numbers.cc for the file
zmax='Body upper/Boundary zmax'
expect 2 'component z: "1/x" is inf at (0, ' "$scene" --set "$zmax/Displacement=-, -, 1/x"
expect_itself 2 'component z: "1/x" is inf at (0, ' "$scene" --set "$zmax/Displacement=-, -, 1/x"
expect 2 'component z: "sqrt(-1-x^2)" is nan at (' "$scene" --set "$zmax/Displacement=-, -, sqrt(-1-x^2)"
expect 2 'component y: "sqrt(-1-x^2)" is nan at (' "$scene" --set "$zmax/Traction=0; sqrt(-1-x^2); 0"
expect 2 'component x: "1/(x-x)" is inf at (' "$scene" --set 'Body upper/Body force=1/(x-x); 0; 0'
expect 2 'Pressure.*: "log(-x)" is nan at (' "$scene" --set "$zmax/Pressure=log(-x)"
expect 2 'in "1/x; 0; 0": the exact displacement.s norm is inf at (0, ' "$scene" \
  --set 'Exact solution/Displacement=1/x; 0; 0'
expect 2 'in "x^4/(x-x); 0; 0": the exact ' "$scene" --set 'Exact solution/Displacement=x^4/(x-x); 0; 0'
expect 2 'with Pressure = "1/(x-x)": the exact ' "$scene" \
  --set 'Body lower/Material/Poisson ratio=0.5' --set 'Body lower/Degree=2' --set 'Exact solution/Pressure=1/(x-x)'
expect 2 '"1e160\*y" is .*e+1.* at (' "$scene" --set "$zmax/Traction=0; 0; 1e160*y"
expect 2 'forces at nodes of at most .*e-20.; allowed: 0, or from 1e-100' "$scene" \
  --set 'Exact solution/Displacement=0; 0; 0' --set "$zmax/Traction=0; 0; 1e-200*x"
expect 2 'got "1e-400", which is too small' "$scene" --set 'Solver/Tolerance=1e-400'
expect 3 'did not converge' "$scene" --set 'Solver/Method=condensed' --set 'Solver/Max iterations=1'
expect_itself 3 'did not converge' "$scene" --set 'Solver/Method=condensed' --set 'Solver/Max iterations=1'

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
