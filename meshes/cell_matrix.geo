// A unit cube without a ball of radius 0.3 in its middle, a cell of a lattice of particles. Its faces are named like those of a
// box and are meshed on their own, so that opposite ones do not match.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Sphere(2) = {0.5, 0.5, 0.5, 0.3};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
e = 1e-6;
xmax() = Surface In BoundingBox {1 - e, -e, -e, 1 + e, 1 + e, 1 + e};
Physical Surface("xmin") = Surface In BoundingBox {-e, -e, -e, e, 1 + e, 1 + e};
Physical Surface("xmax") = {xmax()};
Physical Surface("ymin") = Surface In BoundingBox {-e, -e, -e, 1 + e, e, 1 + e};
Physical Surface("ymax") = Surface In BoundingBox {-e, 1 - e, -e, 1 + e, 1 + e, 1 + e};
Physical Surface("zmin") = Surface In BoundingBox {-e, -e, -e, 1 + e, 1 + e, e};
Physical Surface("zmax") = Surface In BoundingBox {-e, -e, 1 - e, 1 + e, 1 + e, 1 + e};
Physical Surface("hole") = Surface In BoundingBox {0.1, 0.1, 0.1, 0.9, 0.9, 0.9};
Physical Volume("matrix") = {3};
MeshSize{:} = 0.25;
MeshSize{ PointsOf{ Surface{xmax()}; } } = 0.2;
