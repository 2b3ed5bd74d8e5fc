// A ring between the radii 1 and 1.6 and one between 1.5 and 2, whole, of hexahedra, which overlap.
SetFactory("Built-in");
DefineConstant[ mesh_size = 1 ];
length = 0.5;

// Ring between the radii a and b, from the tag n on: m cells around.
Macro Ring
  Point(n) = {0, 0, 0};
  For i In {0:1}
    r = (i == 0) ? a : b;
    For c In {0:3}
      Point(n + 10 * i + 1 + c) = {r * Cos(c * Pi / 2 + turned), r * Sin(c * Pi / 2 + turned), 0};
    EndFor
    For c In {1:4}
      Circle(n + 10 * i + c) = {n + 10 * i + c, n, n + 10 * i + ((c == 4) ? 1 : c + 1)};
    EndFor
    Transfinite Curve{n + 10 * i + 1:n + 10 * i + 4} = m / 4 + 1;
  EndFor
  For c In {1:4}
    Line(n + 20 + c) = {n + c, n + 10 + c};
  EndFor
  Transfinite Curve{n + 21:n + 24} = 2;
  For c In {1:4}
    Curve Loop(n + c) = {n + 20 + c, n + 10 + c, -(n + 20 + ((c == 4) ? 1 : c + 1)), -(n + c)};
    Plane Surface(n + c) = {n + c};
  EndFor
  Transfinite Surface{n + 1:n + 4};
  Recombine Surface{n + 1:n + 4};
  ring() = Extrude {0, 0, length} { Surface{n + 1:n + 4}; Layers{1}; Recombine; };
Return

a = 1; b = 1.6; m = 12; n = 1000; turned = 0;
Call Ring;
Physical Volume("inner") = {ring(1), ring(7), ring(13), ring(19)};
Physical Surface("inner outside") = {ring(3), ring(9), ring(15), ring(21)};
Physical Surface("inner inside") = {ring(5), ring(11), ring(17), ring(23)};
Physical Surface("inner ends") = {n + 1:n + 4, ring(0), ring(6), ring(12), ring(18)};

a = 1.5; b = 2; m = 16; n = 2000; turned = 0.3;
Call Ring;
Physical Volume("outer") = {ring(1), ring(7), ring(13), ring(19)};
Physical Surface("outer outside") = {ring(3), ring(9), ring(15), ring(21)};
Physical Surface("outer inside") = {ring(5), ring(11), ring(17), ring(23)};
Physical Surface("outer ends") = {n + 1:n + 4, ring(0), ring(6), ring(12), ring(18)};
