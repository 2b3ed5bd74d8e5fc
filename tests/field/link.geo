// A link in the plane z = 0.5 .. 1 from (2, 0) to (3.5, -2), with a pin of radius 0.3 below its one end and a hole at its other end.
SetFactory("OpenCASCADE");
Cylinder(1) = {2, 0, 0, 0, 0, 1, 0.3};
Box(2) = {2, -0.5, 0.5, 2.5, 1, 0.5};
Rotate { {0, 0, 1}, {2, 0, 0}, -Acos(0.6) } { Volume{2}; }
Cylinder(3) = {2, 0, 0.5, 0, 0, 0.5, 0.5};
Cylinder(4) = {3.5, -2, 0.5, 0, 0, 0.5, 0.5};
BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{2, 3, 4}; Delete; };
Cylinder(6) = {3.5, -2, 0.5, 0, 0, 0.5, 0.25};
BooleanDifference(7) = { Volume{5}; Delete; }{ Volume{6}; Delete; };
e = 1e-4;
pin() = Surface In BoundingBox{1.7 - e, -0.3 - e, -e, 2.3 + e, 0.3 + e, 0.5 + e};
pin() -= Surface In BoundingBox{1, -1, -e, 3, 1, e};
Physical Surface("pin") = pin();
Physical Surface("hole") = Surface In BoundingBox{3.25 - e, -2.25 - e, 0.5 - e, 3.75 + e, -1.75 + e, 1 + e};
Physical Surface("above") = Surface In BoundingBox{1, -3, 1 - e, 5, 1, 1 + e};
Physical Volume("link") = {7};
Mesh.MeshSizeMax = 0.5;
Mesh.MeshSizeFromCurvature = 24;
