// A lever in the plane z = 0 .. 0.5 along x with two holes of radius 0.3: its pivot at the origin, another one at x = 2.
SetFactory("OpenCASCADE");
Box(1) = {-1.5, -0.6, 0, 4.1, 1.2, 0.5};
Cylinder(2) = {0, 0, 0, 0, 0, 0.5, 0.3};
Cylinder(3) = {2, 0, 0, 0, 0, 0.5, 0.3};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
e = 1e-4;
Physical Surface("pivot") = Surface In BoundingBox{-0.3 - e, -0.3 - e, -e, 0.3 + e, 0.3 + e, 0.5 + e};
Physical Surface("hole") = Surface In BoundingBox{1.7 - e, -0.3 - e, -e, 2.3 + e, 0.3 + e, 0.5 + e};
Physical Surface("end") = Surface In BoundingBox{-1.5 - e, -1, -e, -1.5 + e, 1, 0.5 + e};
Physical Surface("below") = Surface In BoundingBox{-2, -1, -e, 3, 1, e};
Physical Surface("above") = Surface In BoundingBox{-2, -1, 0.5 - e, 3, 1, 0.5 + e};
Physical Volume("lever") = {4};
Mesh.MeshSizeMax = 0.5;
Mesh.MeshSizeFromCurvature = 24;
