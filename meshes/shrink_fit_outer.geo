// A ring in hexahedra, radii 2 and 3, length 1: 4 cells around a quarter, 1 radially.
r = 2; R = 3;
Point(1) = {0, 0, 0};
For i In {0:3}
  Point(10 + i) = {r * Cos(i * Pi/2), r * Sin(i * Pi/2), 0};
  Point(20 + i) = {R * Cos(i * Pi/2), R * Sin(i * Pi/2), 0};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(10 + i) = {10 + i, 1, 10 + j};
  Circle(20 + i) = {20 + i, 1, 20 + j};
  Line(30 + i) = {10 + i, 20 + i};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Curve Loop(i + 1) = {10 + i, 30 + j, -(20 + i), -(30 + i)};
  Plane Surface(i + 1) = {i + 1};
EndFor
Transfinite Curve{10:13, 20:23} = 5;
Transfinite Curve{30:33} = 2;
Transfinite Surface{1:4};
Recombine Surface{1:4};
For i In {1:4}
  out() = Extrude{0, 0, 1}{ Surface{i}; Layers{1}; Recombine; };
  ends() += {i, out(0)};
  inside() += {out(2)};
  outside() += {out(4)};
EndFor
Physical Volume("ring") = Volume{:};
Physical Surface("inside") = inside();
Physical Surface("outside") = outside();
Physical Surface("ends") = ends();
