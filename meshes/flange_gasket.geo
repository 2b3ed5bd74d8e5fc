// Gasket of the flanged pipe joint, a quarter of it, in hexahedra: radii 50 and
// 80, from z = 0 to 3; millimetres. Boundaries: bore, outside, bottom, top,
// xmin, ymin.
SetFactory("Built-in");
DefineConstant[ mesh_size = 9 ];
Point(1) = {0, 0, 0};
Point(2) = {50, 0, 0};
Point(3) = {80, 0, 0};
Point(4) = {0, 80, 0};
Point(5) = {0, 50, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = Ceil(30 / mesh_size) + 1;
Transfinite Curve{2, 4} = Ceil(100 / mesh_size) + 1;
Transfinite Surface{1};
Recombine Surface{1};
e() = Extrude{0, 0, 3}{ Surface{1}; Layers{1}; Recombine; };
Physical Volume("gasket", 1) = {e(1)};
Physical Surface("bottom", 1) = {1};
Physical Surface("top", 2) = {e(0)};
Physical Surface("ymin", 3) = {e(2)};
Physical Surface("outside", 4) = {e(3)};
Physical Surface("xmin", 5) = {e(4)};
Physical Surface("bore", 6) = {e(5)};
