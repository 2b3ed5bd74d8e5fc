// A parallelepiped with a smaller one cut out of one of its corners, in
// tetrahedra. Boundaries: seat, the three faces of what is cut out; outside,
// all else. corner_hex.geo is a part that fits in.
//   gmsh -3 -format msh41 corner_tet.geo
SetFactory("OpenCASCADE");
DefineConstant[ mesh_size = 0.7 ];
Box(1) = {-1, -1, -1, 2, 2, 2};
Box(2) = {0, 0, 0, 1, 1, 1};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Affine{1, 0.3, 0.2, 0,  0, 1, -0.4, 0,  0, 0, 1, 0} { Volume{:}; }
e = 1e-3;
seat() = Surface In BoundingBox{-e, -0.4 - e, -e, 1.5 + e, 1 + e, 1 + e};
outside() = Surface{:};
outside() -= {seat()};
MeshSize{:} = mesh_size;

Physical Volume("corner") = {Volume{:}};
Physical Surface("seat") = {seat()};
Physical Surface("outside") = {outside()};
