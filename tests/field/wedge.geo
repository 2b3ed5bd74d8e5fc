// A wedge, 1 wide at z = 0 and 2 wide at z = 2, 1 long, whose sides slope by 1 : 4.
SetFactory("Built-in");
Point(1) = {-0.5, 0, 0}; Point(2) = {0.5, 0, 0}; Point(3) = {1, 0, 2}; Point(4) = {-1, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
s() = Extrude{0, 1, 0}{ Surface{1}; };
Physical Surface("right") = {s(3)};
Physical Surface("top") = {s(4)};
Physical Surface("left") = {s(5)};
Physical Surface("front") = {1};
Physical Volume("wedge") = {s(1)};
Mesh.MeshSizeMax = 0.6;
