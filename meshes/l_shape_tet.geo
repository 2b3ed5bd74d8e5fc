// The upper half of Fichera's corner, (-1,1)^2 x (0,1) without the quarter x > 0, y > 0, in
// tetrahedra. Boundaries as in l_shape.geo.
//   gmsh -3 l_shape_tet.geo
SetFactory("Built-in");
DefineConstant[ mesh_size = 0.7 ];
Point(1) = {-1, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 0, 0};
Point(4) = {0, 0, 0};   Point(5) = {0, 1, 0};  Point(6) = {-1, 1, 0};
For i In {1:6}
  Line(i) = {i, (i == 6) ? 1 : i + 1};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
block[] = Extrude{0, 0, 1}{ Surface{1}; };
MeshSize{:} = mesh_size;
Physical Volume("corner", 1) = {block[1]};
Physical Surface("zmin", 1) = {1};
Physical Surface("zmax", 2) = {block[0]};
Physical Surface("sides", 3) = {block[2], block[3], block[6], block[7]};
Physical Surface("inner sides", 4) = {block[4], block[5]};
