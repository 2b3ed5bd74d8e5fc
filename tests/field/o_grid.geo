// A thick ring in second-order hexahedra, an O-grid of four blocks.
r = 1; R = 2;
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
Transfinite Curve{10:13, 20:23} = 4;
Transfinite Curve{30:33} = 3;
Transfinite Surface{1:4};
Recombine Surface{1:4};
out() = Extrude{0, 0, 0.5}{ Surface{1:4}; Layers{1}; Recombine; };
Physical Volume("ring") = Volume{:};
bottom() = Surface In BoundingBox{-3, -3, -0.01, 3, 3, 0.01};
Physical Surface("bottom") = bottom();
Physical Surface("top") = Surface In BoundingBox{-3, -3, 0.49, 3, 3, 0.51};
Mesh.ElementOrder = 2;
