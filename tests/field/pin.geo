// A pin of radius 0.5 around z, from -0.2 to 0.5.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, -0.2, 0, 0, 0.7, 0.5};
Physical Volume("pin") = {1};
e = 1e-3;
ends() = Surface In BoundingBox{-1, -1, -0.2 - e, 1, 1, -0.2 + e};
top() = Surface In BoundingBox{-1, -1, 0.5 - e, 1, 1, 0.5 + e};
side() = Boundary{ Volume{1}; };
side() = Abs(side());
side() -= ends();
side() -= top();
Physical Surface("end") = ends();
Physical Surface("side") = side();
Mesh.MeshSizeMax = 0.4;
Mesh.MeshSizeFromCurvature = 14;
