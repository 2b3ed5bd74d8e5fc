// A quarter of a pipe as a CAD program leaves it: its faces have no names.
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 0.4 ];
Cylinder(1) = {0, 0, 0, 0, 0, 1, 2, Pi / 2};
Cylinder(2) = {0, 0, 0, 0, 0, 1, 1, Pi / 2};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
