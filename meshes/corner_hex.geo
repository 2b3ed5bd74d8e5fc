// The parallelepiped that is cut out of corner_tet.geo, in hexahedra.
// Boundaries: seat, three faces that meet in a vertex; outside, all else.
//   gmsh -3 -format msh41 corner_hex.geo
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 0.5 ];
Box(1) = {0, 0, 0, 1, 1, 1};
e = 1e-3;
seat() = {Surface In BoundingBox{-e, -e, -e, e, 1 + e, 1 + e},
          Surface In BoundingBox{-e, -e, -e, 1 + e, e, 1 + e},
          Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e}};
outside() = Surface{:};
outside() -= {seat()};
Affine{1, 0.3, 0.2, 0,  0, 1, -0.4, 0,  0, 0, 1, 0} { Volume{:}; }
Transfinite Curve{:} = Ceil(1 / mesh_size) + 1;
Transfinite Surface{:};
Recombine Surface{:};
Transfinite Volume{:};

Physical Volume("part") = {Volume{:}};
Physical Surface("seat") = {seat()};
Physical Surface("outside") = {outside()};
