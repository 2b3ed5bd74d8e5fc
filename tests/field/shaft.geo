// A round shaft of radius 1 and length 2 along z.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 2, 1};
e = 1e-3;
Physical Volume("shaft") = {1};
bottom() = Surface In BoundingBox{-1 - e, -1 - e, -e, 1 + e, 1 + e, e};
top() = Surface In BoundingBox{-1 - e, -1 - e, 2 - e, 1 + e, 1 + e, 2 + e};
side() = Surface{:};
side() -= {bottom(), top()};
Physical Surface("bottom") = bottom();
Physical Surface("top") = top();
Physical Surface("side") = side();
