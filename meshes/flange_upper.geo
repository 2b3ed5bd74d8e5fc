// Upper half of the flanged pipe joint, a quarter of it, in tetrahedra: a flange
// from z = 3 to 23, a collar of radius 72 up to z = 40, a pipe up to z = 90; else as
// flange_lower.geo. Boundaries: bore, collar, pipe (outside), rim, holes, face (z = 3),
// back (z = 23, where the heads of the bolts sit), end (z = 90), xmin, ymin.
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 14 ];
Cylinder(1) = {0, 0, 3, 0, 0, 20, 115, Pi/2};
Cylinder(2) = {0, 0, 23, 0, 0, 17, 72, Pi/2};
Cylinder(3) = {0, 0, 40, 0, 0, 50, 60, Pi/2};
Cylinder(4) = {0, 0, 0, 0, 0, 100, 50};
Cylinder(5) = {89.61631, 37.1203, 0, 0, 0, 30, 9};
Cylinder(6) = {37.1203, 89.61631, 0, 0, 0, 30, 9};
BooleanUnion(7) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
BooleanDifference(8) = { Volume{7}; Delete; }{ Volume{4, 5, 6}; Delete; };
MeshSize{:} = mesh_size;
Mesh.MeshSizeFromCurvature = 0;

Physical Volume("upper flange", 1) = {8};
xmin() = Surface In BoundingBox{-0.1, -1, 2, 0.1, 116, 91};
ymin() = Surface In BoundingBox{-1, -0.1, 2, 116, 0.1, 91};
face() = Surface In BoundingBox{-1, -1, 2.9, 116, 116, 3.1};
back() = Surface In BoundingBox{-1, -1, 22.9, 116, 116, 23.1};
end() = Surface In BoundingBox{-1, -1, 89.9, 116, 116, 90.1};
holes() = Surface In BoundingBox{20, 20, 2, 108, 108, 24};
bore() = Surface In BoundingBox{-1, -1, 2, 51, 51, 91};
bore() -= {xmin(), ymin()};
pipe() = Surface In BoundingBox{-1, -1, 39.9, 61, 61, 91};
pipe() -= {xmin(), ymin(), end()};
collar() = Surface In BoundingBox{-1, -1, 22.9, 73, 73, 40.1};
collar() -= {xmin(), ymin(), end()};
collar() -= Surface In BoundingBox{-1, -1, 39.9, 73, 73, 40.1};
rim() = Surface In BoundingBox{-1, -1, 2, 116, 116, 24};
rim() -= {xmin(), ymin(), face(), back(), holes()};
Physical Surface("xmin", 1) = xmin();
Physical Surface("ymin", 2) = ymin();
Physical Surface("face", 3) = face();
Physical Surface("back", 4) = back();
Physical Surface("end", 5) = end();
Physical Surface("holes", 6) = holes();
Physical Surface("bore", 7) = bore();
Physical Surface("pipe", 8) = pipe();
Physical Surface("collar", 9) = collar();
Physical Surface("rim", 10) = rim();
