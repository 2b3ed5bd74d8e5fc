// The half y > 0 of a round block below z = 0, of radius and depth 0.75, in hexahedra: rings of thickness mesh_size between the radii 0.1 and 0.165, where
// a contact slips and ends, a half square and four rings within them, and layers that grow by a constant ratio near 1.5 outwards and in depth.
// Boundaries: contact (z = 0), y0, far.
DefineConstant[ mesh_size = 0.008 ];
q = 0.05; L = 0.75;
r() = {0.1, 0.165, L};
m = Ceil(0.022 / mesh_size); // cells along an eighth of the circle

// k layers up to the length l (times the first one), each s times as thick as the one before
Macro Grow
  k = Round(Log(1 + l * 0.5) / Log(1.5));
  s = 1.5;
  For i In {1:60}
    s = (1 + (s - 1) * l)^(1 / k);
  EndFor
Return

Point(1) = {0, 0, 0};
For i In {0:3}
  c = Cos(i * Pi/4 + Floor(i / 2) * Pi/4);
  d = (i == 0 || i == 3) ? 0 : Sin(Pi/4);
  Point(10 + i) = {(i == 0 || i == 3) ? c * q : c * q * 1.2, d * q * 1.2, 0};
  For j In {0:2}
    Point(20 + 10 * j + i) = {r(j) * c, r(j) * d, 0};
  EndFor
EndFor
For i In {0:2}
  Line(10 + i) = {10 + i, 11 + i};
  Transfinite Curve{10 + i} = ((i == 1) ? 2 * m : m) + 1;
  For j In {0:2}
    Circle(20 + 10 * j + i) = {20 + 10 * j + i, 1, 21 + 10 * j + i};
    Transfinite Curve{20 + 10 * j + i} = ((i == 1) ? 2 * m : m) + 1;
  EndFor
EndFor
Line(14) = {10, 13};
Transfinite Curve{14} = 2 * m + 1;
l = (L - r(1)) / mesh_size;
Call Grow;
For i In {0:3}
  For j In {0:2}
    Line(50 + 10 * j + i) = {10 + 10 * j + i, 20 + 10 * j + i};
  EndFor
  Transfinite Curve{50 + i} = 3;
  Transfinite Curve{60 + i} = Round((r(1) - r(0)) / mesh_size) + 1;
  Transfinite Curve{70 + i} = k + 1 Using Progression s;
EndFor
Curve Loop(1) = {10, 11, 12, -14};
Plane Surface(1) = {1};
contact() = {1};
For i In {0:2}
  For j In {0:2}
    Curve Loop(10 * j + i + 2) = {10 + 10 * j + i, 51 + 10 * j + i, -(20 + 10 * j + i), -(50 + 10 * j + i)};
    Plane Surface(10 * j + i + 2) = {10 * j + i + 2};
    contact() += {10 * j + i + 2};
  EndFor
EndFor
Transfinite Surface{contact()};
Recombine Surface{contact()};
l = L / mesh_size / 1.5;
Call Grow;
For i In {1:k}
  heights() += (s^i - 1) / (s^k - 1);
  ones() += 1;
EndFor
Extrude{0, 0, -L}{ Surface{contact()}; Layers{ones(), heights()}; Recombine; }
e = 1e-4;
y0() = Surface In BoundingBox{-L - e, -e, -L - e, L + e, e, e};
far() = CombinedBoundary{ Volume{:}; };
far() = Abs(far());
far() -= contact();
far() -= y0();
Physical Volume("block") = Volume{:};
Physical Surface("contact") = contact();
Physical Surface("y0") = y0();
Physical Surface("far") = far();
