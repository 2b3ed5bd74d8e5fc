// A clip: a ring (radii 0.9 and 1.1) that is open at its right, with round
// ends, and short parts by which it is pressed.
DefineConstant[ n = 3 ];
SetFactory("Built-in");
ri = 0.9; ro = 1.1; w = 0.1;
a[] = {18 * Pi / 180, 40 * Pi / 180, 70 * Pi / 180, Pi, 290 * Pi / 180, 320 * Pi / 180, 342 * Pi / 180};
m[] = {2, 3, 10, 10, 3, 2};
Point(1) = {0, 0, 0};
For i In {0:6}
  Point(10 + i) = {ri * Cos(a[i]), ri * Sin(a[i]), 0};
  Point(20 + i) = {ro * Cos(a[i]), ro * Sin(a[i]), 0};
EndFor
For i In {1:5}
  Line(30 + i) = {10 + i, 20 + i};
EndFor
// the round ends, about the middle of the thickness
For s In {0:1}
  c = Cos(a[6 * s]); d = Sin(a[6 * s]); t = 2 * s - 1;
  Point(2 + s) = {c, d, 0};
  Point(4 + s) = {c - 0.1 * t * d, d + 0.1 * t * c, 0};
  Circle(70 + 2 * s) = {10 + 6 * s, 2 + s, 4 + s};
  Circle(71 + 2 * s) = {4 + s, 2 + s, 20 + 6 * s};
EndFor
For i In {0:5}
  Circle(40 + i) = {10 + i, 1, 11 + i};
  Circle(50 + i) = {20 + i, 1, 21 + i};
  Transfinite Curve{40 + i, 50 + i} = n * m[i] + 1;
EndFor
Curve Loop(60) = {70, 71, 50, -31, -40};
Curve Loop(65) = {35, 55, -73, -72, -45};
For i In {1:4}
  Curve Loop(60 + i) = {30 + i, 50 + i, -(31 + i), -(40 + i)};
EndFor
For i In {0:5}
  Plane Surface(60 + i) = {60 + i};
EndFor
Transfinite Curve{31:35} = 2 * n + 1;
Transfinite Curve{70:73} = n + 1;
Transfinite Surface{61:64};
Transfinite Surface{60} = {10, 20, 21, 11};
Transfinite Surface{65} = {15, 25, 26, 16};
Recombine Surface{60:65};
first[]  = Extrude {0, 0, w} { Surface{60}; Layers{1}; Recombine; };
middle[] = Extrude {0, 0, w} { Surface{61:64}; Layers{1}; Recombine; };
last[]   = Extrude {0, 0, w} { Surface{65}; Layers{1}; Recombine; };
Physical Volume("clip") = {first[1], middle[1], middle[7], middle[13], middle[19], last[1]};
Physical Surface("tip_a") = {first[2], first[3]};
Physical Surface("tip_b") = {last[4], last[5]};
Physical Surface("top") = {middle[3]};
Physical Surface("bottom") = {middle[21]};
Physical Surface("sides") = {60:65, first[0], middle[0], middle[6], middle[12], middle[18], last[0]};
