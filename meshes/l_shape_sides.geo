// l_shape.geo, the upper half of Fichera's corner, with sides that have names of their own: xmin, xmax (x = 1, beside y < 0), ymin,
// ymax, and inner x, inner y, the sides x = 0 and y = 0 of the missing quarter. Three hexahedra.
//   gmsh -3 -format msh22 l_shape_sides.geo -o l_shape_sides.msh
n = 1;
Point(1) = {-1, -1, 0}; Point(2) = {0, -1, 0}; Point(3) = {1, -1, 0};
Point(4) = {-1, 0, 0};  Point(5) = {0, 0, 0};  Point(6) = {1, 0, 0};
Point(7) = {-1, 1, 0};  Point(8) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {7, 8};
Line(6) = {1, 4}; Line(7) = {4, 7}; Line(8) = {2, 5}; Line(9) = {5, 8}; Line(10) = {3, 6};
Curve Loop(1) = {1, 8, -3, -6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 10, -4, -8}; Plane Surface(2) = {2};
Curve Loop(3) = {3, 9, -5, -7}; Plane Surface(3) = {3};
Transfinite Curve {1:10} = n + 1;
Transfinite Surface {1:3};
Recombine Surface {1:3};
a[] = Extrude {0, 0, 1} { Surface{1}; Layers{n}; Recombine; };
b[] = Extrude {0, 0, 1} { Surface{2}; Layers{n}; Recombine; };
c[] = Extrude {0, 0, 1} { Surface{3}; Layers{n}; Recombine; };
Physical Volume("corner") = {a[1], b[1], c[1]};
Physical Surface("zmin") = {1, 2, 3};
Physical Surface("zmax") = {a[0], b[0], c[0]};
Physical Surface("xmin") = {a[5], c[5]};
Physical Surface("xmax") = {b[3]};
Physical Surface("ymin") = {a[2], b[2]};
Physical Surface("ymax") = {c[4]};
Physical Surface("inner x") = {c[3]};
Physical Surface("inner y") = {b[4]};
