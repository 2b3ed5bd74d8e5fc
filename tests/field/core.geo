// A quarter of a round core of radius 1 and length 0.5 along z.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 0.5, 1, Pi/2};
e = 1e-4;
Physical Surface("left") = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 0.5 + e};
Physical Surface("below") = Surface In BoundingBox{-e, -e, -e, 1 + e, e, 0.5 + e};
bottom() = Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e};
top() = Surface In BoundingBox{-e, -e, 0.5 - e, 1 + e, 1 + e, 0.5 + e};
Physical Surface("ends") = {bottom(), top()};
side() = Surface{:};
side() -= {bottom(), top(), Surface In BoundingBox{-e, -e, -e, e, 1 + e, 0.5 + e}, Surface In BoundingBox{-e, -e, -e, 1 + e, e, 0.5 + e}};
Physical Surface("side") = side();
Physical Volume("core") = {1};
Mesh.MeshSizeMax = 0.5;
