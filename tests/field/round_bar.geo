// A round bar of radius 1 along y that touches the plane z = 0 along the line x = 0.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 1, 0, 1, 0, 1};
Physical Volume("bar") = {1};
side() = Surface In BoundingBox{-2, 0.0001, -1, 2, 0.9999, 3};
all() = Surface{:};
e = 1e-4;
front() = Surface In BoundingBox{-2, -e, -1, 2, e, 3};
back() = Surface In BoundingBox{-2, 1 - e, -1, 2, 1 + e, 3};
all() -= {front(), back()};
Physical Surface("round") = all();
Physical Surface("ends") = {front(), back()};
Mesh.MeshSizeMax = 0.4;
