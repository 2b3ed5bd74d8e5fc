// A quarter of the upper half of an O-ring: radius 4, section of radius 1. Its faces are of second order, since straight ones cost 4 % of the force.
Mesh.ElementOrder = 2;
SetFactory("OpenCASCADE");
Torus(1) = {0, 0, 0, 4, 1, Pi / 2};
Box(2) = {-1, -1, 0, 7, 7, 2};
BooleanIntersection(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
e = 1e-3;
Physical Volume("ring") = {3};
Physical Surface("xmin") = Surface In BoundingBox {-e, -e, -e, e, 6, 2};
Physical Surface("ymin") = Surface In BoundingBox {-e, -e, -e, 6, e, 2};
Physical Surface("zmin") = Surface In BoundingBox {-e, -e, -e, 6, 6, e};
all() = Boundary { Volume{3}; };
flat() = Surface In BoundingBox {-e, -e, -e, e, 6, 2};
flat() += Surface In BoundingBox {-e, -e, -e, 6, e, 2};
flat() += Surface In BoundingBox {-e, -e, -e, 6, 6, e};
all() -= flat();
Physical Surface("skin") = {all()};
