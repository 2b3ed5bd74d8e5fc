// A wheel: a ring between the radii 0.3 and 0.5, of hexahedra.
DefineConstant[ n = 10 ];
SetFactory("Built-in");
Point(1) = {0, 0, 0};
For c In {0:3}
  Point(10 + c) = {0.3 * Cos(c * Pi / 2), 0, 0.3 * Sin(c * Pi / 2)};
  Point(20 + c) = {0.5 * Cos(c * Pi / 2), 0, 0.5 * Sin(c * Pi / 2)};
  Line(30 + c)  = {10 + c, 20 + c};
EndFor
For c In {0:3}
  d = (c == 3) ? 0 : c + 1;
  Circle(40 + c) = {10 + c, 1, 10 + d};
  Circle(50 + c) = {20 + c, 1, 20 + d};
  Curve Loop(60 + c) = {30 + c, 50 + c, -(30 + d), -(40 + c)};
  Plane Surface(60 + c) = {60 + c};
EndFor
Transfinite Curve{40:43, 50:53} = n + 1;
Transfinite Curve{30:33} = 3;
Transfinite Surface{60:63};
Recombine Surface{60:63};
e[] = Extrude {0, 0.2, 0} { Surface{60:63}; Layers{1}; Recombine; };
Physical Volume("wheel") = {e[1], e[7], e[13], e[19]};
Physical Surface("tread") = {e[3], e[9], e[15], e[21]};
Physical Surface("hub") = {e[5], e[11], e[17], e[23]};
Physical Surface("sides") = {60:63, e[0], e[6], e[12], e[18]};
