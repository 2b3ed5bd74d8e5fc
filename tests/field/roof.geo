// A gable roof of 2 x 3 from z = 1, its ridge at z = 2.
Point(1) = {0, 0, 1}; Point(2) = {2, 0, 1}; Point(3) = {2, 3, 1}; Point(4) = {0, 3, 1};
Point(5) = {0.7, 0.4, 2}; Point(6) = {0.9, 2.8, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {1, 5}; Line(6) = {2, 5}; Line(7) = {3, 6}; Line(8) = {4, 6}; Line(9) = {5, 6};
Line(10) = {2, 6}; Line(11) = {1, 6};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {1, 6, -5}; Plane Surface(2) = {2};
Curve Loop(3) = {3, 8, -7}; Plane Surface(3) = {3};
Curve Loop(4) = {2, 7, -10}; Plane Surface(4) = {4};
Curve Loop(5) = {10, -9, -6}; Plane Surface(5) = {5};
Curve Loop(6) = {4, 11, -8}; Plane Surface(6) = {6};
Curve Loop(7) = {5, 9, -11}; Plane Surface(7) = {7};
Surface Loop(1) = {1:7}; Volume(1) = {1};
Physical Surface("eaves") = {1};
Physical Surface("roof") = {2:7};
Physical Volume("roof") = {1};
Mesh.MeshSizeMax = 0.8;
