// A jaw at the right of wedge.geo.
Point(1) = {0.5, 0, 0}; Point(2) = {2.5, 0, 0}; Point(3) = {2.5, 0, 2}; Point(4) = {1, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
s() = Extrude{0, 1, 0}{ Surface{1}; };
Physical Surface("wall") = {s(3)};
Physical Surface("face") = {s(5)};
Physical Surface("front") = {1};
Physical Volume("jaw") = {s(1)};
Mesh.MeshSizeMax = 0.5;
