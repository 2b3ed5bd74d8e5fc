// A bracket of thickness 0.3: a plate with a hole of radius 0.5 around the origin, from which an arm goes out along x.
SetFactory("OpenCASCADE");
Box(1) = {-0.9, -0.9, 0, 1.8, 1.8, 0.3};
Box(2) = {0.8, -0.4, 0, 0.7, 0.8, 0.3};
Cylinder(3) = {0, 0, -1, 0, 0, 2, 0.5};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
Physical Volume("bracket") = {5};
e = 1e-3;
Physical Surface("hole") = Surface In BoundingBox{-0.5 - e, -0.5 - e, -e, 0.5 + e, 0.5 + e, 0.3 + e};
Mesh.MeshSizeMax = 0.4;
Mesh.MeshSizeFromCurvature = 16;
