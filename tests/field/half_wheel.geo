// Half of a wheel, radii 0.5 and 1, from 100 to 280 degrees about y, a slice of the thickness 0.3, of hexahedra.
SetFactory("Built-in");
Point(1) = {0, 0, 0};
For i In {0:2}
  a = (100 + 90 * i) * Pi / 180;
  Point(10 + i) = {0.5 * Cos(a), 0, 0.5 * Sin(a)};
  Point(20 + i) = {Cos(a), 0, Sin(a)};
  Line(30 + i) = {10 + i, 20 + i};
EndFor
For i In {0:1}
  Circle(40 + i) = {10 + i, 1, 11 + i};
  Circle(50 + i) = {20 + i, 1, 21 + i};
  Curve Loop(60 + i) = {30 + i, 50 + i, -(31 + i), -(40 + i)};
  Plane Surface(60 + i) = {60 + i};
EndFor
Transfinite Curve{40, 41, 50, 51} = 13;
Transfinite Curve{30:32} = 2;
Transfinite Surface{60, 61};
Recombine Surface{60, 61};
w() = Extrude {0, 0.3, 0} { Surface{60, 61}; Layers{1}; Recombine; };
Physical Volume("wheel") = {w(1), w(7)};
Physical Surface("inside") = {w(5), w(11)};
Physical Surface("outside") = {w(3), w(9)};
