// A gravity dam along y, its water side x = 0 upright: 3 wide below, 1 above, 4 high, 2 long.
Point(1) = {0, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {1, 0, 4}; Point(4) = {0, 0, 4};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
s() = Extrude{0, 2, 0}{ Surface{1}; };
Physical Surface("foot") = {s(2)};
Physical Surface("water") = {s(5)};
Physical Volume("dam") = {s(1)};
Mesh.MeshSizeMax = 1.1;
